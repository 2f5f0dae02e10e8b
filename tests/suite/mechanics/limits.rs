//! Where steps are too long: a typed failure, at the step that is known for it.

use surefoot_mechanics::Endpoint;
use surefoot_mechanics::integrators::{Integrator, StepError, StepFailure, Variational};
use surefoot_mechanics::newton::NewtonFailure;
use surefoot_mechanics::systems::{DoubleSphericalPendulum, FreeRigidBody};

/// 3000 steps of the body of table 2.1, whose second point an accurate motion gives. Largest relative
/// change of its energy.
fn rigid_body(h: f64) -> Result<f64, StepError> {
    let body = FreeRigidBody::PRINTED;
    let (q, rate) = ([1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.5, 2.0]);
    let mut fine = Variational::<_, 4, 1, 5>::from_velocity(body, h / 2000.0, q, rate);
    for _ in 0..2000 {
        fine.step()?;
    }
    let mut motion = Variational::<_, 4, 1, 5>::from_two(body, h, q, *fine.configuration());
    let mut first = None;
    let mut largest = 0.0_f64;
    for _ in 0..3000 {
        let x = *motion.configuration();
        motion.step()?;
        let omega = FreeRigidBody::angular_velocity(&x, motion.mean_velocity());
        let energy = body.kinetic_energy(&omega);
        largest = largest.max((energy / *first.get_or_insert(energy) - 1.0).abs());
    }
    Ok(largest)
}

/// Up to the fold the body keeps its energy to round-off; behind it the equations still have roots,
/// but of another motion, which is said at the first step.
#[test]
fn the_wrong_branch_is_an_error() {
    for h in [0.1, 0.2, 0.3, 0.335] {
        let change = rigid_body(h).expect("all steps are made");
        // Next to the fold round-off is magnified; the wrong branch shows at 4e-2.
        assert!(change < 1e-9, "{h} s: {change}");
    }
    for h in [0.34, 0.36, 0.5, 0.7] {
        let error = rigid_body(h).expect_err("beyond the fold");
        assert_eq!((error.failure, error.step), (StepFailure::WrongBranch, 0), "{h} s");
    }
}

/// The pendulum's equations lose their root near 0.18 s; no step is made there.
#[test]
fn a_lost_root_is_an_error() {
    let pendulum = DoubleSphericalPendulum::PRINTED;
    let (q, v) = pendulum.printed_start();
    let run = |h: f64| -> Result<(), StepError> {
        let mut motion = Variational::<_, 6, 2, 8>::from_velocity(Endpoint(pendulum), h, q, v);
        for _ in 0..(30.0 / h) as usize {
            motion.step()?;
            assert!(
                motion.mean_velocity().iter().chain(motion.configuration()).all(|x| x.is_finite())
            );
        }
        Ok(())
    };
    run(0.1).expect("all steps are made");
    for h in [0.25, 0.3, 0.4] {
        let failure = run(h).expect_err("no such step").failure;
        assert!(
            matches!(
                failure,
                StepFailure::WrongBranch | StepFailure::Newton(NewtonFailure::NoRootNearby { .. })
            ),
            "{h} s: {failure}"
        );
    }
}

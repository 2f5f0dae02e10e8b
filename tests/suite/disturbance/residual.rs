//! The residual against forward dynamics: what acts from outside in a motion is what is read of it.

use super::in_axes;
use nalgebra::Vector3;
use rand::SeedableRng;
use rand_pcg::Pcg64;

use surefoot::Real;
use surefoot::balance::{WholeBody, WholeBodyFoot, WholeBodyState};
use surefoot::dynamics::{DynamicsFault, body_poses, forward_dynamics, joint_poses};
use surefoot::disturbance::{ObserverFault, Residual, ground_forces};
use surefoot::model::Tree;
use surefoot::spatial::{Quaternion, Wrench};
use surefoot_tests::legged_trees::{Legged, feet_f32, five, near_stance, quadruped, seven};
use surefoot_tests::random_trees::symmetric;

/// s
const PERIOD: f64 = 2e-3;

/// What acts from outside, and what is read of it.
struct Case<const N: usize, const NQ: usize, const NV: usize> {
    states: [WholeBodyState<f64, NQ, NV>; 2],
    torques: [f64; NV],
    /// On the central body about its centre of mass, world axes.
    on_central: Wrench<f64>,
    /// On each foot about its reference point, world axes.
    on_feet: [Wrench<f64>; 4],
}

/// A moving robot near its stance on which wrenches act that its contacts can give, and the next state by
/// forward dynamics: velocities that differ by its accelerations times the period.
fn case<const N: usize, const NQ: usize, const NV: usize>(
    rng: &mut Pcg64,
    robot: &Legged<N, NQ, NV>,
) -> Case<N, NQ, NV> {
    let state = near_stance(rng, robot, 1.0);
    let poses = joint_poses(&robot.tree, &state.positions).expect("finite");
    let bodies = body_poses(&robot.tree, &poses);
    let mut torques = symmetric::<NV>(rng).map(|x| 20.0 * x);
    torques[..6].fill(0.0);
    let mut wrench = |size: f64| {
        let [f, m] = [(); 2].map(|()| Vector3::from(symmetric::<3>(rng)));
        Wrench { force: f * (100.0 * size), torque: m * (10.0 * size) }
    };
    let on_central = wrench(1.0);
    let mut external = [Wrench::zero(); N];
    external[0] = in_axes(&bodies[0], on_central);
    let mut on_feet = [Wrench::zero(); 4];
    for (on_foot, foot) in on_feet.iter_mut().zip(&robot.feet) {
        let Some(foot) = foot else { continue };
        let body = &bodies[foot.body];
        *on_foot = wrench(1.0);
        let [x, y, z] = foot.limits.patch.moments();
        if !z {
            on_foot.torque = Vector3::zeros();
        } else if !(x && y) {
            // An edge along x: no moment about it.
            let edge: Vector3<f64> = body.rotation.column(0).into();
            on_foot.torque -= edge * edge.dot(&on_foot.torque);
        }
        let arm = body.rotation * foot.reference;
        external[foot.body] += in_axes(body, on_foot.shifted(arm));
    }
    let moved = forward_dynamics(&robot.tree, &poses, &state.velocities, &torques, Some(&external));
    let accelerations = moved.expect("a robot");
    let mut next = state;
    for (v, a) in next.velocities.iter_mut().zip(accelerations) {
        *v += a * PERIOD;
    }
    Case { states: [state, next], torques, on_central, on_feet }
}

/// Largest difference of wrenches, N and N·m.
fn apart<T: Real>(a: Wrench<T>, b: Wrench<f64>) -> f64 {
    let both = a.to_array().map(Real::to_f64).into_iter().zip(b.to_array());
    both.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Largest error of feet and central body, with a pole at one tick: nothing is held back.
fn error<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    feet: &[Option<WholeBodyFoot<T>>; 4],
    case: &Case<N, NQ, NV>,
) -> [f64; 2] {
    let robot = WholeBody::new(tree, feet).expect("a legged robot");
    let period = T::of(PERIOD);
    let mut residual = Residual::new(period, T::one() / period).expect("numbers that can be");
    let [first, second] = case.states.map(|state| WholeBodyState {
        positions: state.positions.map(T::of),
        velocities: state.velocities.map(T::of),
    });
    let torques = case.torques.map(T::of);
    assert!(residual.update(tree, &first, &torques).expect("finite").is_none());
    let reading = residual.update(tree, &second, &torques).expect("finite").expect("second tick");
    let found = ground_forces(tree, &robot, &reading);
    let mut base = Wrench::from_array(*reading.r.first_chunk::<6>().expect("six"));
    let mut worst = 0.0_f64;
    for (found, wanted) in found.iter().zip(&case.on_feet) {
        let Some(found) = found else { continue };
        worst = worst.max(apart(found.wrench, *wanted));
        base -= found.wrench.shifted(found.position);
    }
    [worst, apart(base, case.on_central)]
}

fn worst<const N: usize, const NQ: usize, const NV: usize>(
    make: fn(&mut Pcg64) -> Legged<N, NQ, NV>,
) -> [[f64; 2]; 2] {
    let mut rng = Pcg64::seed_from_u64(18);
    let mut all = [[0.0_f64; 2]; 2];
    for _ in 0..50 {
        let robot = make(&mut rng);
        let case = case(&mut rng, &robot);
        let single = feet_f32(&robot.feet);
        let found = [
            error(&robot.tree, &robot.feet, &case),
            error(&robot.tree.to_f32(), &single, &case),
        ];
        for (all, found) in all.iter_mut().zip(found) {
            for (all, found) in all.iter_mut().zip(found) {
                *all = all.max(found);
            }
        }
    }
    all
}

/// Measured in f64: 1.8e-13 N and 4.8e-13 N on points, 1.7e-13 and 7.1e-13 on edges, 3.3e-13 and 1.2e-12 on
/// soles; in f32 at most 2.0e-4 and 1.1e-3. Wrenches are of 100 N and 10 N·m.
#[test]
fn residual_is_what_acts_from_outside() {
    for [double, single] in [worst(quadruped), worst(five), worst(seven)] {
        assert!(double[0] < 1e-12 && double[1] < 4e-12, "{double:?}");
        assert!(single[0] < 6e-4 && single[1] < 3.5e-3, "{single:?}");
    }
}

#[test]
fn residual_refuses_what_cannot_be() {
    let bad = |period, rate| Residual::<f64, 1, 7, 6>::new(period, rate).expect_err("no residual");
    assert_eq!(bad(0.0, 80.0), ObserverFault::Period);
    assert_eq!(bad(f64::NAN, 80.0), ObserverFault::Period);
    assert_eq!(bad(2e-3, 501.0), ObserverFault::Rate);
    assert_eq!(bad(2e-3, f64::NAN), ObserverFault::Rate);
}

/// A reading gone wrong is a fault, and is not remembered.
#[test]
fn residual_forgets_numbers_that_are_not_finite() {
    let robot = quadruped(&mut Pcg64::seed_from_u64(3));
    let mut residual = Residual::new(PERIOD, 80.0).expect("numbers that can be");
    let mut positions = [0.0; 19];
    positions[3..7].copy_from_slice(&Quaternion::<f64>::identity().to_array());
    let good = WholeBodyState { positions, velocities: [0.0; 18] };
    let torques = [0.0; 18];
    assert!(residual.update(&robot.tree, &good, &torques).expect("first").is_none());
    let before = residual.update(&robot.tree, &good, &torques).expect("second").expect("a reading");
    let mut bad = good;
    bad.velocities[7] = f64::NAN;
    let fault = residual.update(&robot.tree, &bad, &torques).expect_err("not finite");
    assert!(matches!(fault, DynamicsFault::ResultNotFinite { .. }));
    bad = good;
    bad.positions[8] = f64::INFINITY;
    let fault = residual.update(&robot.tree, &bad, &torques).expect_err("not finite");
    assert_eq!(fault, DynamicsFault::PositionNotFinite { index: 8 });
    assert!(residual.update(&robot.tree, &good, &torques).expect("a first one again").is_none());
    assert_eq!(*residual.r(), before.r);
}

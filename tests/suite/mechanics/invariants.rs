//! What the methods conserve.

use surefoot_sim::integrators::Variational;
use surefoot_sim::mechanics::Midpoint;
use surefoot_sim::mechanics::systems::{DoubleSphericalPendulum, FreeRigidBody};

/// The momentum map (2.22) over 1e5 steps, to 1e-10 of itself.
#[test]
fn discrete_momentum_is_conserved() {
    let body = FreeRigidBody::PRINTED;
    let (q, rate) = ([1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.5, 2.0]);
    let h = 0.05;
    let mut motion = Variational::<_, 4, 1, 5>::from_velocity(body, h, q, rate);
    let d = motion.clone().step().expect("a step");
    let first = body.discrete_momentum(&q, &d, h);
    let size = first.iter().map(|m| m * m).sum::<f64>().sqrt();
    let mut largest = 0.0_f64;
    for _ in 0..100_000 {
        let x = *motion.configuration();
        let d = motion.step().expect("a step");
        for (now, then) in body.discrete_momentum(&x, &d, h).iter().zip(first) {
            largest = largest.max((now - then).abs() / size);
        }
    }
    println!("rigid body: {largest:.1e}");
    assert!(largest < 1e-10, "{largest}");

    let pendulum = DoubleSphericalPendulum::PRINTED;
    let (q, v) = pendulum.printed_start();
    let mut motion = Variational::<_, 6, 2, 8>::from_velocity(Midpoint(pendulum), 0.02, q, v);
    let about_vertical =
        |x: &[f64; 6], p: &[f64; 6]| x[0] * p[1] - x[1] * p[0] + x[3] * p[4] - x[4] * p[3];
    motion.step().expect("a step");
    let first = about_vertical(motion.configuration(), motion.momentum());
    let mut largest = 0.0_f64;
    for _ in 0..100_000 {
        motion.step().expect("a step");
        let now = about_vertical(motion.configuration(), motion.momentum());
        largest = largest.max((now / first - 1.0).abs());
    }
    println!("double spherical pendulum: {largest:.1e}");
    assert!(largest < 1e-10, "{largest}");
}

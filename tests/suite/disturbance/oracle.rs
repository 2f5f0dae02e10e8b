//! The residual against one that was written by others, on MuJoCo's mass matrix, bias and Jacobians: a biped
//! with a load of 10 kg, pushed by 80 N for a tenth of a second, all within 0.14 s of 500 Hz.

use nalgebra::Vector3;
use serde_json::Value;
use surefoot::balance::{ContactLimits, ContactPatch, WholeBody, WholeBodyFoot, WholeBodyState};
use surefoot::disturbance::{Residual, ground_forces};
use surefoot::model::robots::biped::{self, SoleOutline};
use surefoot::spatial::{Quaternion, Wrench};
use surefoot_tests::vectors::disturbances;

fn numbers<const N: usize>(value: &Value) -> [f64; N] {
    std::array::from_fn(|i| value[i].as_f64().expect("a number"))
}

/// MuJoCo has the velocity of the central body in world axes, here it is in the body's own.
fn state(tick: &Value) -> WholeBodyState<f64, 19, 18> {
    let positions: [f64; 19] = numbers(&tick["q"]);
    let mut velocities: [f64; 18] = numbers(&tick["v"]);
    let q = Quaternion::from_array(std::array::from_fn(|i| positions[3 + i]));
    let linear = q.conjugate().rotate(Vector3::from_fn(|i, _| velocities[i]));
    velocities[..3].copy_from_slice(linear.as_slice());
    WholeBodyState { positions, velocities }
}

/// Measured: 0.013 N of the central body's force, 3.0e-4 N·m of the joints' rows; 1.3 N of 400 N and 0.045 N·m of the feet.
#[test]
fn residual_agrees_with_an_observer_on_mujoco() {
    let vectors = disturbances();
    let limits = ContactLimits {
        least_force: 0.0,
        greatest_force: 1e4,
        friction: 0.6,
        patch: ContactPatch::sole([-0.1, 0.1], [-0.05, 0.05], 0.0),
        torques: [],
    };
    let reference = SoleOutline::A.corners().iter().sum::<Vector3<f64>>() / 4.0;
    let axes = Quaternion::identity();
    let feet = biped::FEET.map(|body| Some(WholeBodyFoot { body, reference, axes, limits }));
    let robot = WholeBody::<f64, 2, 18>::new(&biped::TREE, &feet).expect("a legged robot");
    let period = vectors["period"].as_f64().expect("a number");
    let mut residual =
        Residual::new(period, vectors["rate"].as_f64().expect("a number")).expect("can be");
    let ticks = vectors["ticks"].as_array().expect("a list");
    let mut first_r: [f64; 18] = numbers(&vectors["first_r"]);
    // The moment on the central body is in its own axes there.
    let first = state(&ticks[0]);
    let q = Quaternion::from_array(std::array::from_fn(|i| first.positions[3 + i]));
    let moment = q.rotate(Vector3::from_fn(|i, _| first_r[3 + i]));
    first_r[3..6].copy_from_slice(moment.as_slice());
    residual.restore(&biped::TREE, &first, &first_r);
    let mut worst = [0.0_f64; 4];
    for (number, tick) in ticks.iter().enumerate().skip(1) {
        let torques = {
            let mut all = [0.0; 18];
            all[6..].copy_from_slice(&numbers::<12>(&tick["tau"]));
            all
        };
        let reading = residual.update(&biped::TREE, &state(tick), &torques).expect("finite");
        let reading = reading.expect("not the first");
        let after = vectors["after"].as_array().expect("a list");
        let Some(wanted) = after.iter().find(|after| after["tick"] == number) else { continue };
        let r: [f64; 18] = numbers(&wanted["r"]);
        let apart = |range: std::ops::Range<usize>| {
            range.map(|i| (reading.r[i] - r[i]).abs()).fold(0.0, f64::max)
        };
        worst[0] = worst[0].max(apart(0..3));
        worst[1] = worst[1].max(apart(6..18));
        let found = ground_forces(&biped::TREE, &robot, &reading);
        for (foot, found) in found.iter().enumerate() {
            let found = found.expect("a foot");
            let theirs = Wrench::from_array(numbers(&wanted["feet"][foot]));
            worst[2] = worst[2].max((found.wrench.force - theirs.force).amax());
            worst[3] = worst[3].max((found.wrench.torque - theirs.torque).amax());
        }
    }
    // N, N·m (in motion both are of first order in the period, in other velocities), N, N·m: the forces differ by the
    // damping of 1e-4 that the other one has in every posture.
    let [base, joints, forces, moments] = worst;
    assert!(base < 0.03 && joints < 1e-3, "{worst:?}");
    assert!(forces < 2.5 && moments < 0.1, "{worst:?}");
}

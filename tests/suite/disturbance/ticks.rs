//! Ticks under a known wrench: the equations of motion with it, and nothing changed without.

use super::in_axes;
use nalgebra::Vector3;
use rand::SeedableRng;
use rand_pcg::Pcg64;
use surefoot::Real;
use surefoot::balance::{
    Controller, Ground, LeggedRobot, LimitMemory, Reference, RobotState, Sole, WholeBody,
    WholeBodyController, WholeBodyMemory, WholeBodySettings, WrenchLimits, limited_tick,
    limited_tick_under, whole_body_tick, whole_body_tick_under,
};
use surefoot::dynamics::{body_poses, inverse_dynamics, joint_poses};
use surefoot::model::robots::biped;
use surefoot::spatial::{Quaternion, Twist, Wrench};
use surefoot_tests::legged_trees::{Legged, near_stance, quadruped};

const LOAD: Wrench<f64> = Wrench {
    force: Vector3::new(10.0, -6.0, -40.0),
    torque: Vector3::new(2.0, 5.0, -1.0),
};

/// Largest torque (N·m or N) that is left where accelerations, the ground's wrenches and the load go through
/// inverse dynamics; relative to the largest of the command.
fn left_over<const N: usize, const NQ: usize, const NV: usize>(
    rng: &mut Pcg64,
    robot: &Legged<N, NQ, NV>,
) -> f64 {
    let state = near_stance(rng, robot, 0.2);
    let reference = Reference::at_rest(Vector3::zeros(), Quaternion::identity());
    let mut settings = WholeBodySettings::<f64, NV>::scaled(0.5, 9.81, 4);
    settings.posture = robot.stance;
    let found = WholeBody::new(&robot.tree, &robot.feet).expect("a legged robot");
    let controller =
        WholeBodyController { tree: &robot.tree, robot: &found, settings: &settings };
    let run = |external| {
        let mut memory = WholeBodyMemory::new();
        let around = (&[true; 4], external);
        whole_body_tick_under(&controller, &state, &reference, around, &mut memory)
            .expect("a stance")
    };
    let command = run(Some(LOAD));
    // Without one it is the tick, to the bit.
    let mut memory = WholeBodyMemory::new();
    let plain = whole_body_tick(&controller, &state, &reference, &[true; 4], &mut memory);
    assert_eq!(run(None).torques, plain.expect("a stance").torques);

    let poses = joint_poses(&robot.tree, &state.positions).expect("finite");
    let bodies = body_poses(&robot.tree, &poses);
    let mut external = [Wrench::zero(); N];
    external[0] = in_axes(&bodies[0], LOAD);
    for (foot, w) in robot.feet.iter().zip(&command.foot_wrenches) {
        let Some(foot) = foot else { continue };
        let (body, central) = (&bodies[foot.body], &bodies[0].rotation);
        let w = Wrench { force: central * w.force, torque: central * w.torque };
        external[foot.body] += in_axes(body, w.shifted(body.rotation * foot.reference));
    }
    let accelerations = command.accelerations;
    let made =
        inverse_dynamics(&robot.tree, &poses, &state.velocities, &accelerations, Some(&external));
    let size = command.torques.iter().fold(1.0_f64, |size, x| size.max(x.abs()));
    let apart = made.iter().zip(&command.torques).map(|(a, b)| (a - b).abs());
    apart.fold(0.0, f64::max) / size
}

/// Measured: 2.4e-14.
#[test]
fn whole_body_tick_carries_a_known_wrench() {
    let mut rng = Pcg64::seed_from_u64(5);
    for _ in 0..20 {
        let robot = quadruped(&mut rng);
        let left = left_over(&mut rng, &robot);
        assert!(left < 1e-13, "{left}");
    }
}

/// A biped on both soles, in precision `T`: the sum of what the feet make, and that of the plain tick.
fn sums<T: Real>(robot: &LeggedRobot<T, 2>, external: Option<Wrench<f64>>) -> [Wrench<T>; 2] {
    let of = |v: Vector3<f64>| v.map(T::of);
    let leg = [0.0, 40.0, 0.0, -77.46, 0.0, 37.46].map(|x: f64| T::of(x.to_radians()));
    let turned = Quaternion::from_rotation_vector(of(Vector3::new(0.02, 0.03, -0.05)));
    let state = RobotState {
        position: of(Vector3::new(0.0, 0.0, 1.035)),
        orientation: turned,
        velocity: Twist::zero(),
        joint_angles: [leg; 2],
        joint_rates: [[T::zero(); 6]; 2],
    };
    let reference = Reference::at_rest(state.position, turned);
    let sole = Sole { x: [T::of(-0.2), T::of(0.05)], y: [T::of(-0.05), T::of(0.05)], z: T::of(-0.06) };
    let ground =
        Ground { least_force: T::of(5.0), greatest_force: T::of(2000.0), friction: T::of(0.5) };
    let limits = WrenchLimits::new(robot, &[sole; 2], ground, &[[T::of(500.0); 6]; 2]);
    let limits = limits.expect("soles");
    let controller = Controller::new(robot);
    let tick = |external: Option<Wrench<T>>| {
        let around = (&[true; 2], external);
        let mut memory = LimitMemory::new();
        limited_tick_under(&controller, &limits, &state, &reference, around, &mut memory)
            .expect("a stance")
            .command
    };
    let mut memory = LimitMemory::new();
    let plain = limited_tick(&controller, &limits, &state, &reference, &[true; 2], &mut memory);
    let plain = plain.expect("a stance").command;
    // Without one it is the tick, to the bit.
    assert_eq!(tick(None).joint_torques, plain.joint_torques);
    let external = external.map(|w| Wrench { force: of(w.force), torque: of(w.torque) });
    [tick(external).desired_wrench, plain.desired_wrench]
}

/// Feet are asked for what the load does not give. Measured: 2.8e-14 in f64, 2.5e-5 N in f32.
#[test]
fn limited_tick_asks_for_what_a_known_wrench_leaves() {
    let robot = LeggedRobot::new(&biped::TREE);
    let rotation = Quaternion::<f64>::from_rotation_vector(Vector3::new(0.02, 0.03, -0.05));
    let load = in_axes(
        &surefoot::spatial::Pose { rotation: rotation.to_matrix(), position: Vector3::zeros() },
        LOAD,
    );
    let [under, plain] = sums(&robot, Some(LOAD));
    let off = (plain - under - load).to_array().map(f64::abs);
    let [under, plain] = sums(&robot.to_f32(), Some(LOAD));
    let apart = (plain - under).to_array().into_iter().zip(load.to_array());
    let single = apart.map(|(a, b)| (f64::from(a) - b).abs()).fold(0.0, f64::max);
    assert!(off.iter().all(|x| *x < 1e-13), "{off:?}");
    assert!(single < 1e-4, "{single}");
}

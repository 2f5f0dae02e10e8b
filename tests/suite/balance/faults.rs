//! Where the controller has no answer: a typed fault with its reason, never a bad number.

use nalgebra::Vector3;
use surefoot::Real;
use surefoot::balance::{
    Controller, Fault, FootLimit, FootLimits, Input, LeggedRobot, Reference, RobotState, Sole,
    WorkspaceForm, tick,
};
use surefoot::model::robots::biped;
use surefoot::spatial::{Quaternion, Twist};
use surefoot_tests::random_trees::{random, symmetric};

const ROBOT: LeggedRobot<f64, 2> = LeggedRobot::new(&biped::TREE);
const ROBOT_F32: LeggedRobot<f32, 2> = ROBOT.to_f32();

fn standing<T: Real>() -> (RobotState<T, 2>, Reference<T>) {
    let leg = [0.0, 0.5, 0.0, -1.0, 0.0, 0.5].map(T::of);
    let state = RobotState {
        position: Vector3::new(T::zero(), T::zero(), T::of(1.1)),
        orientation: Quaternion::identity(),
        velocity: Twist::zero(),
        joint_angles: [leg; 2],
        joint_rates: [[T::zero(); 6]; 2],
    };
    (state, Reference::at_rest(state.position, state.orientation))
}

/// Every number of the input in turn is made NaN and infinite.
#[test]
fn inputs_that_are_no_numbers() {
    let controller = Controller::new(&ROBOT);
    let (good, reference) = standing::<f64>();
    assert!(tick(&controller, &good, &reference).is_ok());
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let check = |change: &dyn Fn(&mut RobotState<f64, 2>, &mut Reference<f64>), input| {
            let (mut state, mut reference) = (good, reference);
            change(&mut state, &mut reference);
            let fault = tick(&controller, &state, &reference).expect_err("not a number");
            assert_eq!(fault, Fault::NotFinite(input), "{fault}");
        };
        for i in 0..3 {
            check(&|s, _| s.position[i] = bad, Input::Position);
            check(&|s, _| s.orientation.v[i] = bad, Input::Orientation);
            check(&|s, _| s.velocity.linear[i] = bad, Input::Velocity);
            check(&|s, _| s.velocity.angular[i] = bad, Input::Velocity);
            check(&|_, r| r.position[i] = bad, Input::Reference);
            check(&|_, r| r.velocity[i] = bad, Input::Reference);
            check(&|_, r| r.acceleration[i] = bad, Input::Reference);
            check(&|_, r| r.orientation.v[i] = bad, Input::Reference);
            check(&|_, r| r.angular_velocity[i] = bad, Input::Reference);
            check(&|_, r| r.angular_acceleration[i] = bad, Input::Reference);
        }
        check(&|s, _| s.orientation.s = bad, Input::Orientation);
        check(&|_, r| r.orientation.s = bad, Input::Reference);
        for leg in 0..2 {
            for i in 0..6 {
                check(&|s, _| s.joint_angles[leg][i] = bad, Input::JointAngles(leg));
                check(&|s, _| s.joint_rates[leg][i] = bad, Input::JointRates(leg));
            }
        }
    }
}

#[test]
fn quaternions_that_are_no_orientations() {
    let controller = Controller::new(&ROBOT);
    let (mut state, mut reference) = standing::<f64>();
    state.orientation.s = 0.0;
    let fault = tick(&controller, &state, &reference).expect_err("norm 0");
    assert_eq!(fault, Fault::NotUnit(Input::Orientation));
    (state, reference) = standing();
    reference.orientation.s = 1.01;
    let fault = tick(&controller, &state, &reference).expect_err("norm 1.01");
    assert_eq!(fault, Fault::NotUnit(Input::Reference));
}

fn bent<T: Real>(knee: f64) -> (RobotState<T, 2>, Reference<T>) {
    let (mut state, reference) = standing();
    state.joint_angles[1][3] = T::of(-knee);
    (state, reference)
}

/// From a bent to a straight knee: torques grow as 1/θ, then there is a fault; at no angle is there
/// a bad number. In both forms and both precisions.
#[test]
fn a_straight_knee() {
    let leg = 1;
    let straight = Err(Fault::SingularLeg { leg });
    for form in [WorkspaceForm::FixedFoot, WorkspaceForm::BigBase { factor: 1e6 }] {
        let mut controller = Controller::new(&ROBOT);
        controller.form = form;
        let mut knee = 1.0;
        let mut faults = 0;
        while knee > 1e-12 {
            let (state, reference) = bent(knee);
            match tick(&controller, &state, &reference) {
                Ok(command) => {
                    assert_eq!(faults, 0, "torques at {knee} rad, but not at a larger angle");
                    assert!(command.joint_torques.as_flattened().iter().all(|t| t.is_finite()));
                }
                Err(fault) => {
                    assert_eq!(fault, Fault::SingularLeg { leg });
                    faults += 1;
                }
            }
            knee *= 0.8;
        }
        assert!(faults > 0);
        let (state, reference) = bent(0.0);
        assert_eq!(tick(&controller, &state, &reference).map(|_| ()), straight);
    }
    let (state, reference) = bent(0.0);
    let controller = Controller::new(&ROBOT_F32);
    assert_eq!(tick(&controller, &state, &reference).map(|_| ()), straight);
}

#[test]
fn the_margin_to_the_singularity_is_the_users() {
    let mut controller = Controller::new(&ROBOT);
    let (state, reference) = bent(0.05);
    controller.singularity = 1e-4;
    assert!(tick(&controller, &state, &reference).is_ok());
    controller.singularity = 0.5;
    let fault = tick(&controller, &state, &reference).expect_err("within the margin");
    assert!(matches!(fault, Fault::SingularLeg { .. }));
}

#[test]
fn finite_but_too_large() {
    let controller = Controller::new(&ROBOT_F32);
    let (good, reference) = standing::<f32>();
    for change in [
        |s: &mut RobotState<f32, 2>| s.joint_rates[0] = [1e30; 6],
        |s: &mut RobotState<f32, 2>| s.velocity.angular = Vector3::new(1e25, 1e25, 1e25),
        |s: &mut RobotState<f32, 2>| s.position = Vector3::new(3e38, -3e38, 3e38),
    ] {
        let mut state = good;
        change(&mut state);
        assert_eq!(tick(&controller, &state, &reference).map(|_| ()), Err(Fault::Overflow));
    }
}

#[test]
fn wrenches_that_the_ground_cannot_give() {
    let mut controller = Controller::new(&ROBOT);
    let sole = Sole { x: [-0.2015, 0.0503], y: [-0.05, 0.05], z: -0.06 };
    controller.foot_limits = FootLimits::new(0.0, Some(0.3), Some(sole)).ok();
    let (state, good) = standing::<f64>();
    assert!(tick(&controller, &state, &good).is_ok());
    let fault = |change: &dyn Fn(&mut Reference<f64>)| {
        let mut reference = good;
        change(&mut reference);
        tick(&controller, &state, &reference).expect_err("too much for a foot")
    };
    // Down faster than free fall: the feet would have to pull.
    let pull = fault(&|r| r.acceleration.z = -15.0);
    assert!(matches!(pull, Fault::FootWrench { limit: FootLimit::Pull, .. }), "{pull}");
    let slip = fault(&|r| r.acceleration.y = 5.0);
    assert!(matches!(slip, Fault::FootWrench { limit: FootLimit::Friction, .. }), "{slip}");
    // On ice with spikes: no friction limit, so that the edge of the sole is the first.
    controller.foot_limits = FootLimits::new(0.0, None, Some(sole)).ok();
    let mut reference = good;
    reference.angular_acceleration.y = 60.0;
    let tip = tick(&controller, &state, &reference).expect_err("too much for a foot");
    assert!(matches!(tip, Fault::FootWrench { limit: FootLimit::CenterOfPressure, .. }), "{tip}");
    // Without limits the controller asks for them, as the dissertation's does.
    controller.foot_limits = None;
    let mut reference = good;
    reference.acceleration.z = -15.0;
    assert!(tick(&controller, &state, &reference).is_ok());
}

/// 10 000 states of any kind: each gives finite torques or a fault.
#[test]
fn random_states_never_give_bad_numbers() {
    let mut rng = random(31);
    let (mut torques, mut faults) = (0, 0);
    for _ in 0..10_000 {
        let scale = 10f64.powf(4.0 * symmetric::<1>(&mut rng)[0]);
        let state = RobotState {
            position: Vector3::from(symmetric(&mut rng)) * scale,
            orientation: Quaternion::from_rotation_vector(
                Vector3::from(symmetric(&mut rng)) * scale,
            ),
            velocity: Twist::from_array(symmetric(&mut rng)) * scale,
            joint_angles: [symmetric(&mut rng), symmetric(&mut rng)]
                .map(|l: [f64; 6]| l.map(|x| x * scale)),
            joint_rates: [symmetric(&mut rng), symmetric(&mut rng)]
                .map(|l: [f64; 6]| l.map(|x| x * scale)),
        };
        let (_, reference) = standing();
        match tick(&Controller::new(&ROBOT), &state, &reference) {
            Ok(command) => {
                torques += 1;
                assert!(command.joint_torques.as_flattened().iter().all(|t| t.is_finite()));
            }
            Err(_) => faults += 1,
        }
    }
    println!("{torques} with torques, {faults} faults");
    assert!(torques > 5_000);
}

//! What the ground gives the feet, and limits on it: against vectors made with other software, Newton's
//! law, and the same robot described in other axes.

use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use rand_pcg::Pcg64;
use serde_json::Value;
use surefoot::Real;
use surefoot::balance::{
    Command, Controller, Fault, FootLimit, FootLimits, FootLimitsFault, LeggedRobot, Reference,
    RobotState, Sole, WorkspaceForm, central_body, fixed_foot_wrench, fixed_foot_wrenches,
    leg_kinematics, sole_axes, tick,
};
use surefoot::model::robots::biped;
use surefoot::model::{Link, Tree};
use surefoot::spatial::{Quaternion, Twist};
use surefoot_tests::random_trees::{random, symmetric};
use surefoot_tests::vectors::{self, array, matrix, relative_error};

const BIPED: LeggedRobot<f64, 2> = LeggedRobot::new(&biped::TREE);

/// The biped's body on the biped's legs, at any hips (from the body's centre of mass).
fn robot<const LEGS: usize, const N: usize, const NQ: usize, const NV: usize>(
    hips: &Value,
) -> LeggedRobot<f64, LEGS> {
    let mut links = [biped::CENTRAL; N];
    for (leg, hip) in hips.as_array().expect("hips").iter().enumerate() {
        let [x, y, z]: [f64; 3] = array(hip);
        assert!((z + 0.27).abs() < 1e-12);
        let first = 1 + 6 * leg;
        links[first..first + 6].copy_from_slice(&biped::leg(first + 1, [x, y]));
    }
    LeggedRobot::new(&Tree::<f64, N, NQ, NV>::new(links))
}

/// Errors of `p`, `R` and `c` over the feet of a case.
fn compare<T: Real, const LEGS: usize>(robot: &LeggedRobot<T, LEGS>, case: &Value) -> [f64; 3] {
    let given = &case["state"];
    let numbers = |value: &Value| array::<6>(value).map(T::of);
    let state = RobotState {
        position: Vector3::from(array::<3>(&given["position"]).map(T::of)),
        orientation: Quaternion::from_array(array::<4>(&given["orientation"]).map(T::of)),
        velocity: Twist::from_array(numbers(&given["velocity"])),
        joint_angles: std::array::from_fn(|leg| numbers(&given["joint_angles"][leg])),
        joint_rates: std::array::from_fn(|leg| numbers(&given["joint_rates"][leg])),
    };
    let x = Twist::from_array(numbers(&case["X"]));
    let central = central_body(robot, &state).expect("a unit quaternion");
    let legs = leg_kinematics(robot, &central, &state);
    let margin = T::of(1e-6);
    let held = fixed_foot_wrenches(robot, &central, &legs, margin, x).expect("regular");
    let alone = fixed_foot_wrench(robot, &central, &legs, margin, x).expect("regular");
    assert_eq!(held.on_central_body, alone);
    let axes = sole_axes(robot, &legs);
    let mut worst = [0.0_f64; 3];
    let mut meet = |i: usize, ours: Vec<T>, theirs: &[f64]| {
        let ours: Vec<f64> = ours.iter().map(|x| x.to_f64()).collect();
        worst[i] = worst[i].max(relative_error(&ours, theirs));
    };
    for foot in case["feet"].as_array().expect("feet") {
        let leg = foot["leg"].as_u64().expect("a number") as usize;
        meet(0, legs[leg].foot.position.iter().copied().collect(), &array::<3>(&foot["p"]));
        let rows: [[f64; 3]; 3] = matrix(&foot["R"]);
        meet(1, axes[leg].transpose().iter().copied().collect(), rows.as_flattened());
        meet(2, held.ground_bias[leg].to_array().to_vec(), &array::<6>(&foot["c"]));
    }
    worst
}

/// In f64 and in f32.
fn case_errors<const LEGS: usize, const N: usize, const NQ: usize, const NV: usize>(
    case: &Value,
) -> [[f64; 3]; 2] {
    let double = robot::<LEGS, N, NQ, NV>(&case["hips"]);
    [compare(&double, case), compare(&double.to_f32(), case)]
}

#[test]
fn the_grounds_part_meets_the_vectors() {
    let file = vectors::foot_wrenches();
    let cases = file["cases"].as_array().expect("cases");
    assert_eq!(cases.len(), 45);
    let (mut double, mut single) = ([0.0_f64; 3], [0.0_f64; 3]);
    for case in cases {
        let errors = match case["hips"].as_array().map(Vec::len) {
            Some(2) => case_errors::<2, 13, 19, 18>(case),
            Some(3) => case_errors::<3, 19, 25, 24>(case),
            Some(4) => case_errors::<4, 25, 31, 30>(case),
            legs => panic!("a robot with {legs:?} legs"),
        };
        for i in 0..3 {
            double[i] = double[i].max(errors[0][i]);
            single[i] = single[i].max(errors[1][i]);
        }
    }
    println!("p, R, c: f64 {double:?}, f32 {single:?}");
    // Measured: 1.9e-15 and 7.4e-7, both of c.
    assert!(double.iter().all(|e| *e < 2e-14), "{double:?}");
    assert!(single.iter().all(|e| *e < 5e-6), "{single:?}");
}

fn standing() -> (RobotState<f64, 2>, Reference<f64>) {
    let leg = [0.0, 0.5, 0.0, -1.0, 0.0, 0.5];
    let state = RobotState {
        position: Vector3::new(0.0, 0.0, 1.1),
        orientation: Quaternion::identity(),
        velocity: Twist::zero(),
        joint_angles: [leg; 2],
        joint_rates: [[0.0; 6]; 2],
    };
    (state, Reference::at_rest(state.position, state.orientation))
}

/// Robot, state and reference of a tick with these limits.
fn limited(
    robot: &LeggedRobot<f64, 2>,
    limits: FootLimits<f64>,
    state: &RobotState<f64, 2>,
    reference: &Reference<f64>,
) -> Result<Command<f64, 2>, Fault> {
    let mut controller = Controller::new(robot);
    controller.foot_limits = Some(limits);
    tick(&controller, state, reference)
}

/// At rest the ground carries the whole robot, half of it a foot: its weight is the normal force that
/// the limit sees, to round-off, not that which the joints make.
#[test]
fn the_ground_carries_the_whole_weight() {
    let (state, reference) = standing();
    let half = 0.5 * biped::TREE.mass() * 9.81;
    for form in [WorkspaceForm::FixedFoot, WorkspaceForm::BigBase { factor: 1e6 }] {
        let least = |force: f64| {
            let mut controller = Controller::new(&BIPED);
            controller.form = form;
            controller.foot_limits = Some(FootLimits::new(force, None, None).expect("limits"));
            tick(&controller, &state, &reference)
        };
        // The big base gives way by 1e-6 of the weight.
        let command = least(half * (1.0 - 1e-5)).expect("the ground carries half the weight");
        // The feet's share of the joints' wrenches is far less: a tenth of the load is the legs' own.
        assert!(command.foot_wrenches[0].force.norm() < 0.85 * half);
        let fault = least(half * (1.0 + 1e-5)).map(|_| ());
        assert_eq!(fault, Err(Fault::FootWrench { leg: 0, limit: FootLimit::Pull }));
    }
}

/// The biped with its body's frame turned by `turn`. No leg's axis is along one of the body's then, so
/// that the frame of the last joint is any.
fn turned_biped(turn: &Rotation3<f64>) -> LeggedRobot<f64, 2> {
    let q = UnitQuaternion::from_rotation_matrix(turn);
    let principal = Matrix3::from_diagonal(&Vector3::new(1.67, 1.58, 0.581));
    let i = turn.matrix().transpose() * principal * turn.matrix();
    let tensor = [i.m11, i.m22, i.m33, i.m23, i.m31, i.m12];
    let mut links = [Link::floating(0); 13];
    links[0] = Link::floating(0)
        .body_with_products(45.0, tensor, [0.0, 0.0, 1.23])
        .oriented([q.w, q.i, q.j, q.k]);
    links[1..7].copy_from_slice(&biped::leg(2, [0.0, -0.15]));
    links[7..].copy_from_slice(&biped::leg(8, [0.0, 0.15]));
    LeggedRobot::new(&Tree::<f64, 13, 19, 18>::new(links))
}

/// The state of the same motion for a body frame that is turned.
fn turned_state(state: &RobotState<f64, 2>, turn: &Rotation3<f64>) -> RobotState<f64, 2> {
    let q = UnitQuaternion::from_rotation_matrix(turn);
    let own = state.orientation;
    let body =
        UnitQuaternion::new_normalize(nalgebra::Quaternion::new(own.s, own.v.x, own.v.y, own.v.z))
            * q;
    RobotState {
        orientation: Quaternion::from_array([body.w, body.i, body.j, body.k]),
        velocity: Twist {
            linear: turn.inverse() * state.velocity.linear,
            angular: turn.inverse() * state.velocity.angular,
        },
        ..*state
    }
}

fn random_motion(rng: &mut Pcg64) -> (RobotState<f64, 2>, Reference<f64>) {
    let (mut state, mut reference) = standing();
    let small = |rng: &mut Pcg64, size: f64| Vector3::from(symmetric(rng)) * size;
    state.orientation = Quaternion::from_rotation_vector(small(rng, 0.05));
    state.velocity = Twist { linear: small(rng, 0.05), angular: small(rng, 0.1) };
    for leg in 0..2 {
        let noise: [f64; 6] = symmetric(rng);
        let rates: [f64; 6] = symmetric(rng);
        for k in 0..6 {
            state.joint_angles[leg][k] += 0.05 * noise[k];
            state.joint_rates[leg][k] = 0.1 * rates[k];
        }
    }
    reference.acceleration = small(rng, 2.0);
    reference.angular_acceleration = small(rng, 3.0);
    (state, reference)
}

/// The wrenches of the ground and what the limits say of them belong to the robot, not to the frame
/// that describes its body.
#[test]
fn limits_do_not_depend_on_the_frames_of_the_joints() {
    let sole = Sole { x: [-0.2015, 0.0503], y: [-0.05, 0.05], z: -0.06 };
    let mut rng = random(61);
    let (mut worst, mut faults, mut sound) = (0.0_f64, [0; 3], 0);
    for case in 0..300 {
        let turn = Rotation3::new(Vector3::from(symmetric(&mut rng)) * 2.0);
        let robot = turned_biped(&turn);
        let (state, mut reference) = random_motion(&mut rng);
        // The set point is the body's present pose, in either frame.
        reference.orientation = state.orientation;
        let other = turned_state(&state, &turn);
        let other_reference = Reference { orientation: other.orientation, ..reference };

        let x = Twist::from_array(symmetric(&mut rng));
        let other_x =
            Twist { linear: turn.inverse() * x.linear, angular: turn.inverse() * x.angular };
        let bias = |robot: &LeggedRobot<f64, 2>, state: &RobotState<f64, 2>, x| -> Vec<f64> {
            let central = central_body(robot, state).expect("unit");
            let legs = leg_kinematics(robot, &central, state);
            let held = fixed_foot_wrenches(robot, &central, &legs, 1e-3, x).expect("regular");
            held.ground_bias.iter().flat_map(|w| w.to_array()).collect()
        };
        let (ours, theirs) = (bias(&BIPED, &state, x), bias(&robot, &other, other_x));
        worst = worst.max(relative_error(&theirs, &ours));

        // Each limit alone in turn.
        let limits = match case % 3 {
            0 => FootLimits::new(330.0, None, None),
            1 => FootLimits::new(0.0, Some(0.25), None),
            _ => FootLimits::new(0.0, None, Some(sole)),
        };
        let limits = limits.expect("limits");
        let own = limited(&BIPED, limits, &state, &reference);
        let turned = limited(&robot, limits, &other, &other_reference);
        match (own, turned) {
            (Ok(own), Ok(turned)) => {
                sound += 1;
                let all = |c: &Command<f64, 2>| c.joint_torques.as_flattened().to_vec();
                worst = worst.max(relative_error(&all(&turned), &all(&own)));
            }
            (own, turned) => {
                let (own, turned) = (own.map(|_| ()), turned.map(|_| ()));
                assert_eq!(own, turned);
                match own.expect_err("a fault") {
                    Fault::FootWrench { limit: FootLimit::Pull, .. } => faults[0] += 1,
                    Fault::FootWrench { limit: FootLimit::Friction, .. } => faults[1] += 1,
                    Fault::FootWrench { limit: FootLimit::CenterOfPressure, .. } => faults[2] += 1,
                    fault => panic!("{fault}"),
                }
            }
        }
    }
    println!("largest relative difference {worst:e}; {sound} within limits, {faults:?} beyond");
    // Measured: 2.1e-15.
    assert!(worst < 2e-14, "{worst:e}");
    assert!(sound > 20 && faults.iter().all(|n| *n > 10), "{sound} {faults:?}");
}

/// A leg of six joints, each axis of this sense.
fn leg(first: usize, y: f64, sense: &[f64; 6]) -> [Link; 6] {
    const AXES: [[f64; 3]; 6] = [
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.0, 1.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
    ];
    let heights = [0.9, 0.88, 0.85, 0.5, 0.1, 0.08];
    std::array::from_fn(|k| {
        let inboard = if k == 0 { 1 } else { first + k - 1 };
        let axis = AXES[k].map(|x| x * sense[k]);
        Link::revolute(inboard, axis, [0.0, y, heights[k]])
            .body(1.0 + k as f64, [0.02, 0.03, 0.015], [0.01, y, heights[k] - 0.05])
            .rotor_inertia(0.1)
    })
}

fn two_legs(sense: [[f64; 6]; 2]) -> LeggedRobot<f64, 2> {
    let mut links = [biped::CENTRAL; 13];
    links[1..7].copy_from_slice(&leg(2, -0.15, &sense[0]));
    links[7..].copy_from_slice(&leg(8, 0.15, &sense[1]));
    LeggedRobot::new(&Tree::<f64, 13, 19, 18>::new(links))
}

/// A joint whose axis is described the other way round has the opposite angle, rate and torque, to the
/// last bit.
#[test]
fn a_reversed_joint_has_the_opposite_torque() {
    let plain = two_legs([[1.0; 6]; 2]);
    let mut rng = random(62);
    for _ in 0..100 {
        let sense: [[f64; 6]; 2] =
            std::array::from_fn(|_| symmetric::<6>(&mut rng).map(f64::signum));
        let robot = two_legs(sense);
        let signed = |all: [[f64; 6]; 2]| -> [[f64; 6]; 2] {
            std::array::from_fn(|l| std::array::from_fn(|k| all[l][k] * sense[l][k]))
        };
        let (state, reference) = random_motion(&mut rng);
        let mut reversed = state;
        reversed.joint_angles = signed(state.joint_angles);
        reversed.joint_rates = signed(state.joint_rates);
        for form in [WorkspaceForm::FixedFoot, WorkspaceForm::BigBase { factor: 1e4 }] {
            let torques = |robot: &LeggedRobot<f64, 2>, state: &RobotState<f64, 2>| {
                let mut controller = Controller::new(robot);
                controller.form = form;
                tick(&controller, state, &reference).expect("regular").joint_torques
            };
            assert_eq!(signed(torques(&robot, &reversed)), torques(&plain, &state));
        }
    }
}

#[test]
fn limits_that_are_none() {
    let sole = Sole { x: [-0.1, 0.1], y: [-0.05, 0.05], z: -0.06 };
    assert!(FootLimits::new(0.0, Some(0.0), Some(sole)).is_ok());
    let fault = |force, friction, sole| FootLimits::new(force, friction, sole).expect_err("none");
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1e-9] {
        assert_eq!(fault(bad, None, None), FootLimitsFault::LeastNormalForce);
        assert_eq!(fault(0.0, Some(bad), None), FootLimitsFault::Friction);
        if !bad.is_finite() {
            for ends in [[bad, 0.1], [-0.1, bad]] {
                assert_eq!(
                    fault(0.0, None, Some(Sole { x: ends, ..sole })),
                    FootLimitsFault::SoleX
                );
                assert_eq!(
                    fault(0.0, None, Some(Sole { y: ends, ..sole })),
                    FootLimitsFault::SoleY
                );
            }
            assert_eq!(fault(0.0, None, Some(Sole { z: bad, ..sole })), FootLimitsFault::SoleZ);
        }
    }
    let inverted = Some(Sole { x: [0.1, -0.1], ..sole });
    assert_eq!(fault(0.0, None, inverted), FootLimitsFault::SoleX);
    let inverted = Some(Sole { y: [0.05, 0.049], ..sole });
    assert_eq!(fault(0.0, None, inverted), FootLimitsFault::SoleY);
    assert_eq!(FootLimits::new(f32::NAN, None, None), Err(FootLimitsFault::LeastNormalForce));
}

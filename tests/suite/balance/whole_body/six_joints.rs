//! On legs of six joints with soles, while no limit binds, it is the plain tick.

use super::feet_f32;
use nalgebra::{SMatrix, SVector, Vector3};
use surefoot::balance::{
    ContactLimits, ContactPatch, ContactWeights, Controller, Gains, LeggedRobot, Reference,
    RobotState, WholeBody, WholeBodyController, WholeBodyFoot, WholeBodyMemory, WholeBodySettings,
    WholeBodyState, tick, whole_body_tick,
};
use surefoot::dynamics::{body_velocities, joint_poses};
use surefoot::model::Tree;
use surefoot::model::robots::biped;
use surefoot::spatial::{Quaternion, Twist};
use surefoot_tests::quadruped;
use surefoot_tests::random_trees::{random, symmetric};

/// Ground that gives anything, about the foot's centre of mass.
fn feet<const LEGS: usize>(bodies: [usize; LEGS]) -> [Option<WholeBodyFoot<f64>>; 4] {
    let limits = ContactLimits {
        least_force: 0.0,
        greatest_force: 1e5,
        friction: 1e3,
        patch: ContactPatch::sole([-1e3, 1e3], [-1e3, 1e3], 0.0),
        torques: [],
    };
    std::array::from_fn(|leg| {
        let (reference, axes) = (Vector3::zeros(), Quaternion::identity());
        Some(WholeBodyFoot { body: *bodies.get(leg)?, reference, axes, limits })
    })
}

/// Greatest difference of torques in f64 and f32, of the greatest torque.
fn compare<const LEGS: usize, const C: usize, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<f64, N, NQ, NV>,
    robot: &LeggedRobot<f64, LEGS>,
    bodies: [usize; LEGS],
    leg: [f64; 6],
) -> [f64; 2] {
    let mut rng = random(41);
    let feet = feet(bodies);
    let model = WholeBody::new(tree, &feet).expect("a legged robot");
    let (tree_f32, robot_f32) = (tree.to_f32(), robot.to_f32());
    let model_f32 = WholeBody::new(&tree_f32, &feet_f32(&feet)).expect("a legged robot");
    let settings = WholeBodySettings {
        gains: Gains::experiments(),
        weights: ContactWeights { norm_length: 1.0, ..ContactWeights::standing() },
        ..WholeBodySettings::<f64, NV>::scaled(1.0, 9.81, LEGS)
    };
    let settings_f32 = WholeBodySettings {
        gains: Gains::experiments(),
        weights: ContactWeights { norm_length: 1.0, ..ContactWeights::standing() },
        ..WholeBodySettings::<f32, NV>::scaled(1.0, 9.81, LEGS)
    };
    let (mut worst, mut compared) = ([0.0_f64; 2], 0);
    for _ in 0..200 {
        let angles: [[f64; 6]; LEGS] = std::array::from_fn(|_| {
            let off: [f64; 6] = symmetric(&mut rng);
            std::array::from_fn(|k| leg[k] + 0.2 * off[k])
        });
        let axis = Vector3::from(symmetric(&mut rng)) * 0.2;
        let orientation = Quaternion::from_rotation_vector(axis);
        let position = Vector3::from(symmetric(&mut rng)) + Vector3::new(0.0, 0.0, 1.0);
        let mut positions = [0.0; NQ];
        positions[..3].copy_from_slice(position.as_slice());
        positions[3..7].copy_from_slice(&orientation.to_array());
        positions[7..].copy_from_slice(angles.as_flattened());
        let mut velocities = [0.0; NV];
        let twist: [f64; 6] = symmetric::<6>(&mut rng).map(|x| 0.3 * x);
        velocities[..6].copy_from_slice(&twist);
        // Rates with which the feet keep still.
        let poses = joint_poses(tree, &positions).expect("a configuration");
        let mut jacobian = SMatrix::<f64, C, NV>::zeros();
        for column in 0..NV {
            let mut unit = [0.0; NV];
            unit[column] = 1.0;
            let twists = body_velocities(tree, &poses, &unit);
            for (foot, body) in bodies.iter().enumerate() {
                for (row, x) in twists[*body].to_array().into_iter().enumerate() {
                    jacobian[(6 * foot + row, column)] = x;
                }
            }
        }
        let of_base = jacobian.fixed_columns::<6>(0) * SVector::from(twist);
        for foot in 0..LEGS {
            let block = jacobian.fixed_view::<6, 6>(6 * foot, 6 + 6 * foot).into_owned();
            let rates = block.lu().solve(&-of_base.fixed_rows::<6>(6 * foot).into_owned());
            velocities[6 + 6 * foot..12 + 6 * foot]
                .copy_from_slice(rates.expect("bent").as_slice());
        }
        let reference = Reference::at_rest(position, Quaternion::identity());
        let state = RobotState {
            position,
            orientation,
            velocity: Twist::from_array(twist),
            joint_angles: angles,
            joint_rates: std::array::from_fn(|leg| {
                std::array::from_fn(|k| velocities[6 + 6 * leg + k])
            }),
        };
        let Ok(plain) = tick(&Controller::new(robot), &state, &reference) else { continue };
        let whole = whole_body_tick(
            &WholeBodyController { tree, robot: &model, settings: &settings },
            &WholeBodyState { positions, velocities },
            &reference,
            &[true; 4],
            &mut WholeBodyMemory::new(),
        )
        .expect("torques");
        if whole.limits.is_limited() {
            continue;
        }
        compared += 1;
        let plain_torques = plain.joint_torques.as_flattened();
        let size = plain_torques.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
        for (a, b) in plain_torques.iter().zip(&whole.torques[6..]) {
            worst[0] = worst[0].max((a - b).abs() / size);
        }
        let narrow = |v: &Vector3<f64>| v.map(|x| x as f32);
        let state_f32 = RobotState {
            position: narrow(&position),
            orientation: Quaternion::from_array(orientation.to_array().map(|x| x as f32)),
            velocity: Twist::from_array(twist.map(|x| x as f32)),
            joint_angles: angles.map(|leg| leg.map(|x| x as f32)),
            joint_rates: state.joint_rates.map(|leg| leg.map(|x| x as f32)),
        };
        let reference_f32 = Reference::at_rest(state_f32.position, Quaternion::identity());
        let plain_f32 =
            tick(&Controller::new(&robot_f32), &state_f32, &reference_f32).expect("torques");
        let whole_f32 = whole_body_tick(
            &WholeBodyController { tree: &tree_f32, robot: &model_f32, settings: &settings_f32 },
            &WholeBodyState {
                positions: positions.map(|x| x as f32),
                velocities: velocities.map(|x| x as f32),
            },
            &reference_f32,
            &[true; 4],
            &mut WholeBodyMemory::new(),
        )
        .expect("torques");
        for (a, b) in plain_f32.joint_torques.as_flattened().iter().zip(&whole_f32.torques[6..]) {
            worst[1] = worst[1].max(f64::from(a - b).abs() / size);
        }
    }
    assert!(compared > 100, "{compared}");
    worst
}

#[test]
fn legs_of_six_joints_have_the_torques_of_the_plain_tick() {
    let bent = [0.0, 0.5, 0.0, -1.0, 0.0, 0.5];
    let robot = LeggedRobot::new(&biped::TREE);
    let [double, single] = compare::<2, 12, 13, 19, 18>(&biped::TREE, &robot, biped::FEET, bent);
    // Measured: 1.8e-15 and 1.0e-6, 3.2e-15 and 1.5e-6.
    assert!(double < 1e-14 && single < 5e-6, "{double:e} {single:e}");
    let bent = [0.0, 0.5, -1.0, 0.0, 0.5, 0.0];
    let (tree, feet) = (&quadruped::TREE, quadruped::FEET);
    let [double, single] = compare::<4, 24, 25, 31, 30>(tree, &quadruped::ROBOT, feet, bent);
    assert!(double < 2e-14 && single < 8e-6, "{double:e} {single:e}");
}

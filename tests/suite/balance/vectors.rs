//! Algorithms 4.1 to 4.6 against vectors made with other software, in both forms of the workspace
//! dynamics and both precisions. Relative errors are to the largest number of each result.

use nalgebra::Vector3;
use serde_json::Value;
use surefoot::Real;
use surefoot::balance::{
    Controller, LeggedRobot, Reference, RobotState, WorkspaceForm, big_base, central_body,
    fixed_foot_dynamics, leg_kinematics, tick,
};
use surefoot::model::robots::biped;
use surefoot::spatial::{Quaternion, Twist};
use surefoot_tests::vectors::{self, array, matrix, relative_error};

const ROBOT: LeggedRobot<f64, 2> = LeggedRobot::new(&biped::TREE);
const ROBOT_F32: LeggedRobot<f32, 2> = ROBOT.to_f32();

/// Largest error of each result over the cases of the file.
#[derive(Debug, Default)]
struct Errors {
    orientation_error: f64,
    foot_pose: f64,
    inertia: f64,
    bias: f64,
    wrench: f64,
    feet: f64,
    torque: f64,
}

impl Errors {
    fn all(&self) -> [f64; 7] {
        [
            self.orientation_error,
            self.foot_pose,
            self.inertia,
            self.bias,
            self.wrench,
            self.feet,
            self.torque,
        ]
    }
}

fn vector<T: Real>(value: &Value) -> Vector3<T> {
    Vector3::from(array::<3>(value).map(T::of))
}

fn legs<T: Real>(value: &Value) -> [[T; 6]; 2] {
    let all: [f64; 12] = array(value);
    [0, 6].map(|start| std::array::from_fn(|i| T::of(all[start + i])))
}

fn state<T: Real>(case: &Value) -> RobotState<T, 2> {
    let state = &case["state"];
    RobotState {
        position: vector(&state["p"]),
        orientation: Quaternion::from_array(array::<4>(&state["q"]).map(T::of)),
        velocity: Twist::from_array(array::<6>(&state["V"]).map(T::of)),
        joint_angles: legs(&state["th"]),
        joint_rates: legs(&state["thd"]),
    }
}

fn reference<T: Real>(case: &Value) -> Reference<T> {
    let set = &case["setpoint"];
    Reference::at_rest(vector(&set["p"]), Quaternion::from_array(array::<4>(&set["q"]).map(T::of)))
}

fn doubles<T: Real>(numbers: &[T]) -> Vec<f64> {
    numbers.iter().map(|x| x.to_f64()).collect()
}

fn worst(all: &mut f64, ours: &[f64], theirs: &[f64]) {
    *all = all.max(relative_error(ours, theirs));
}

/// The form's name in the file: "" for the big base, "_exact" for fixed feet.
fn compare<T: Real>(robot: &LeggedRobot<T, 2>, form: WorkspaceForm<T>, suffix: &str) -> Errors {
    let file = vectors::controller();
    let mut controller = Controller::new(robot);
    controller.form = form;
    let mut errors = Errors::default();
    let cases = file["cases"].as_array().expect("cases");
    assert_eq!(cases.len(), 11);
    for case in cases {
        let state = state(case);
        let central = central_body(robot, &state).expect("a unit quaternion");
        let legs = leg_kinematics(robot, &central, &state);
        let dynamics = match form {
            WorkspaceForm::FixedFoot => fixed_foot_dynamics(robot, &central, &legs, T::of(1e-3)),
            WorkspaceForm::BigBase { factor } => big_base(robot, &central, &legs, factor),
        }
        .expect("a regular state");
        let p: [[f64; 6]; 6] = matrix(&case[format!("P1{suffix}")]);
        let ours = dynamics.inertia.to_array();
        worst(&mut errors.inertia, &doubles(ours.as_flattened()), p.as_flattened());
        worst(
            &mut errors.bias,
            &doubles(&dynamics.bias.to_array()),
            &array::<6>(&case[format!("z1{suffix}")]),
        );

        for (leg, name) in legs.iter().zip(["foot7", "foot13"]) {
            let world: [[f64; 4]; 4] = matrix(&case[name]);
            let rotation = central.rotation * leg.foot.rotation;
            let position = state.position + central.rotation * leg.foot.position;
            for (i, row) in world.iter().enumerate().take(3) {
                let ours = [rotation[(i, 0)], rotation[(i, 1)], rotation[(i, 2)], position[i]];
                worst(&mut errors.foot_pose, &doubles(&ours), row);
            }
        }

        let command = tick(&controller, &state, &reference(case)).expect("a regular state");
        worst(
            &mut errors.torque,
            &doubles(command.joint_torques.as_flattened()),
            &array::<12>(&case[format!("tau{suffix}")]),
        );
        // The file takes the printed q_d as it is, of norm 1 − 1.6e-9; the tick scales it to 1.
        let q_e = command.orientation_error.to_array();
        let printed = Quaternion::from_array(array::<4>(&case["q_e"]));
        let expected = printed.normalized().expect("not zero").to_array();
        worst(&mut errors.orientation_error, &doubles(&q_e), &expected);
        if suffix.is_empty() {
            worst(
                &mut errors.wrench,
                &doubles(&command.desired_wrench.to_array()),
                &array::<6>(&case["F1bd"]),
            );
            for (foot, name) in command.foot_wrenches.iter().zip(["Fl", "Fr"]) {
                worst(&mut errors.feet, &doubles(&foot.to_array()), &array::<6>(&case[name]));
            }
        }
    }
    errors
}

#[test]
fn exact_foot_meets_the_vectors_in_f64() {
    let errors = compare(&ROBOT, WorkspaceForm::FixedFoot, "_exact");
    println!("{errors:?}");
    assert!(errors.all().iter().all(|e| *e < 1e-9), "{errors:?}");
}

#[test]
fn big_base_meets_the_vectors_in_f64() {
    let errors = compare(&ROBOT, WorkspaceForm::BigBase { factor: 1e6 }, "");
    println!("{errors:?}");
    assert!(errors.all().iter().all(|e| *e < 1e-7), "{errors:?}");
}

#[test]
fn exact_foot_meets_the_vectors_in_f32() {
    let errors = compare(&ROBOT_F32, WorkspaceForm::FixedFoot, "_exact");
    println!("{errors:?}");
    assert!(errors.all().iter().all(|e| *e < 1e-4), "{errors:?}");
}

/// Why the exact foot exists: the printed factor in single precision.
#[test]
fn big_base_in_f32_is_as_bad_as_stated() {
    let errors = compare(&ROBOT_F32, WorkspaceForm::BigBase { factor: 1e3 }, "");
    println!("1e3: {errors:?}");
    assert!(errors.inertia < 2e-3, "{errors:?}");
    let errors = compare(&ROBOT_F32, WorkspaceForm::BigBase { factor: 1e6 }, "");
    println!("1e6: {errors:?}");
    assert!(errors.inertia > 1e-3, "{errors:?}");
}

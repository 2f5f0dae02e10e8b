//! Algorithms 3.1 to 3.3, mass matrix and bias of the biped against vectors made with other
//! software, in both precisions. Relative errors are to the largest number of each result.

use serde_json::Value;
use surefoot::Real;
use surefoot::dynamics::{
    bias_forces, body_poses, body_velocities, forward_dynamics, forward_kinematics,
    inverse_dynamics, joint_poses, mass_matrix,
};
use surefoot::model::robots::biped::{Biped, TREE, TREE_F32};
use surefoot_tests::vectors::{self, array, matrix, relative_error};

/// The largest error of each result over all states of the file.
#[derive(Debug, Default)]
struct Errors {
    pose: f64,
    velocity: f64,
    torque: f64,
    acceleration: f64,
    mass_matrix: f64,
    bias: f64,
}

fn joined<T: Real, const A: usize, const B: usize, const C: usize>(
    a: [f64; A],
    b: [f64; B],
) -> [T; C] {
    let mut all = [T::zero(); C];
    for (to, from) in all.iter_mut().zip(a.into_iter().chain(b)) {
        *to = T::of(from);
    }
    all
}

fn doubles<T: Real>(numbers: &[T]) -> Vec<f64> {
    numbers.iter().map(|x| x.to_f64()).collect()
}

fn worst(all: &mut f64, ours: &[f64], theirs: &[f64]) {
    *all = all.max(relative_error(ours, theirs));
}

fn compare<T: Real>(tree: &Biped<T>) -> Errors {
    let file = vectors::dynamics();
    let mut errors = Errors::default();
    let states = file["states"].as_array().expect("states");
    assert_eq!(states.len(), 10);
    for state in states {
        compare_state(tree, state, &mut errors);
    }
    errors
}

fn compare_state<T: Real>(tree: &Biped<T>, state: &Value, errors: &mut Errors) {
    let p: [f64; 3] = array(&state["p"]);
    let q: [f64; 4] = array(&state["q_quat_wxyz"]);
    let pq: [f64; 7] = joined(p, q);
    let positions = joined(pq, array::<12>(&state["theta"]));
    let velocities = joined(array::<6>(&state["V1_body"]), array::<12>(&state["theta_dot"]));
    let poses = joint_poses(tree, &positions).expect("a valid state");

    let mut ours = Vec::new();
    let mut theirs = Vec::new();
    for (k, pose) in body_poses(tree, &poses).iter().enumerate() {
        let printed: [[f64; 4]; 4] = matrix(&state["poses"][(k + 1).to_string()]);
        for (i, row) in printed.iter().enumerate().take(3) {
            ours.extend((0..3).map(|j| pose.rotation[(i, j)].to_f64()));
            ours.push(pose.position[i].to_f64());
            theirs.extend(row);
        }
    }
    worst(&mut errors.pose, &ours, &theirs);

    let (mut ours, mut theirs) = (Vec::new(), Vec::new());
    for (k, twist) in body_velocities(tree, &poses, &velocities).iter().enumerate() {
        ours.extend(twist.to_array().map(Real::to_f64));
        theirs.extend(array::<6>(&state["body_vel"][(k + 1).to_string()]));
    }
    worst(&mut errors.velocity, &ours, &theirs);

    let accelerations =
        joined(array::<6>(&state["rnea_in_V1dot"]), array::<12>(&state["rnea_in_thetaddot"]));
    let torques = inverse_dynamics(tree, &poses, &velocities, &accelerations, None);
    let expected: [f64; 18] =
        joined(array::<6>(&state["rnea_wrench1"]), array::<12>(&state["rnea_tau"]));
    worst(&mut errors.torque, &doubles(&torques), &expected);

    let torques = joined(array::<6>(&state["wrench1_body"]), array::<12>(&state["tau"]));
    let found = forward_dynamics(tree, &poses, &velocities, &torques, None).expect("finite");
    let expected: [f64; 18] =
        joined(array::<6>(&state["aba_V1dot"]), array::<12>(&state["aba_thetaddot"]));
    worst(&mut errors.acceleration, &doubles(&found), &expected);

    // Alg. 3.1's accelerations agree with the torques they need: body by body they are checked in
    // `identities`; here, that the root's are those given.
    let kinematics = forward_kinematics(tree, &poses, &velocities, &found);
    worst(
        &mut errors.acceleration,
        &kinematics[0].acceleration.to_array().map(Real::to_f64),
        &array::<6>(&state["aba_V1dot"]),
    );

    let m = mass_matrix(tree, &poses);
    let printed: [[f64; 18]; 18] = matrix(&state["mass_matrix"]);
    worst(&mut errors.mass_matrix, &doubles(m.as_flattened()), printed.as_flattened());

    let h = bias_forces(tree, &poses, &velocities, None);
    worst(&mut errors.bias, &doubles(&h), &array::<18>(&state["bias_h"]));
}

#[test]
fn vectors_are_met_in_f64() {
    let errors = compare(&TREE);
    println!("{errors:?}");
    let all = [
        errors.pose,
        errors.velocity,
        errors.torque,
        errors.acceleration,
        errors.mass_matrix,
        errors.bias,
    ];
    assert!(all.iter().all(|e| *e < 1e-11), "{errors:?}");
}

#[test]
fn vectors_are_met_in_f32() {
    let errors = compare(&TREE_F32);
    println!("{errors:?}");
    let all = [
        errors.pose,
        errors.velocity,
        errors.torque,
        errors.acceleration,
        errors.mass_matrix,
        errors.bias,
    ];
    assert!(all.iter().all(|e| *e < 1e-4), "{errors:?}");
}

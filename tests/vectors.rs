//! Independent test vectors (`vectors/*.json`), made with other software.

use serde_json::Value;

/// The dynamics vectors: poses, velocities, accelerations, torques, mass matrix and bias.
pub fn dynamics() -> Value {
    parse(include_str!("vectors/dynamics_vectors.json"))
}

/// The controller vectors: the balance controller, stage by stage.
pub fn controller() -> Value {
    parse(include_str!("vectors/controller_vectors.json"))
}

/// Foot wrenches within limits: states, and what the ground gives beside the joints' wrenches.
pub fn foot_wrenches() -> Value {
    parse(include_str!("vectors/wrench_qp_vectors.json"))
}

/// An arm with rotors, made by `vectors/rotor_vectors.py` with MuJoCo.
pub fn rotors() -> Value {
    parse(include_str!("vectors/rotor_vectors.json"))
}

/// A motion of 10 s through an error-state Kalman filter in numpy, made by `vectors/estimate_vectors.py`.
pub fn estimates() -> Value {
    parse(include_str!("vectors/estimate_vectors.json"))
}

/// Steps and ticks of a planner of walks, made by `vectors/walk_vectors.py` with a program in Python.
pub fn walk() -> Value {
    parse(include_str!("vectors/walk_vectors.json"))
}

/// The biped with feet that press or swing, made by `vectors/motion_vectors.py` with MuJoCo and DAQP.
pub fn motion() -> Value {
    parse(include_str!("vectors/motion_vectors.json"))
}

/// A biped in MuJoCo that carries 10 kg and is pushed, and what an observer in numpy, on MuJoCo's mass matrix, bias and
/// Jacobians, makes of it.
pub fn disturbances() -> Value {
    parse(include_str!("vectors/disturbance_vectors.json"))
}

pub(crate) fn parse(text: &str) -> Value {
    serde_json::from_str(text).expect("the vectors are valid JSON")
}

/// The numbers of an array, which must have `N` of them.
pub fn array<const N: usize>(value: &Value) -> [f64; N] {
    let numbers: Vec<f64> =
        value.as_array().expect("an array").iter().map(|x| x.as_f64().expect("a number")).collect();
    numbers.try_into().expect("as many numbers as asked for")
}

/// A matrix by rows.
pub fn matrix<const R: usize, const C: usize>(value: &Value) -> [[f64; C]; R] {
    let rows: Vec<[f64; C]> = value.as_array().expect("rows").iter().map(array).collect();
    rows.try_into().expect("as many rows as asked for")
}

/// `max |a − b| / max(1, max |b|)`: the error relative to the largest number of the result.
pub fn relative_error(ours: &[f64], theirs: &[f64]) -> f64 {
    assert_eq!(ours.len(), theirs.len());
    let scale = theirs.iter().fold(1.0_f64, |m, x| m.max(x.abs()));
    let error = ours
        .iter()
        .zip(theirs)
        .map(|(a, b)| if a.is_finite() { (a - b).abs() } else { f64::INFINITY })
        .fold(0.0, f64::max);
    error / scale
}

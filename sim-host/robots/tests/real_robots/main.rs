//! Robots of other projects: every URDF of example-robot-data, MJCF models of dm_control and gymnasium.
//!
//! `cargo xtask test --only robots` installs their files and says where they are.

mod compiled;
mod imported;
mod mujoco;
mod pinocchio;

use serde_json::Value;
use std::path::{Path, PathBuf};

/// Where Python's packages are.
fn packages() -> PathBuf {
    let folder = std::env::var_os("SUREFOOT_ROBOT_FILES");
    PathBuf::from(folder.expect("`cargo xtask test --only robots` sets SUREFOOT_ROBOT_FILES"))
}

/// A URDF of example-robot-data.
fn example_robot(path: &str) -> PathBuf {
    packages().join("cmeel.prefix/share/example-robot-data/robots").join(path)
}

/// The workspace's folder.
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn parse(path: &Path) -> Value {
    let text = std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    serde_json::from_str(&text).expect("JSON")
}

/// All numbers of a value, in order.
fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(all) => all.iter().flat_map(numbers).collect(),
        number => vec![number.as_f64().expect("a number")],
    }
}

/// `max |a − b| / max |b|`: the error relative to the largest number of the result.
fn relative_error(ours: &[f64], theirs: &[f64]) -> f64 {
    assert_eq!(ours.len(), theirs.len());
    let scale = theirs.iter().fold(f64::MIN_POSITIVE, |m, x| m.max(x.abs()));
    let difference = ours.iter().zip(theirs).map(|(a, b)| (a - b).abs());
    let worst = difference.fold(0.0, |m, x| if x <= m { m } else { x });
    worst / scale
}

/// The largest error of each of ours against the reference's states, and that of poses of leaf frames.
fn errors(ours: &Value, theirs: &Value) -> [(&'static str, f64); 4] {
    let mut found = [("rnea", 0.0_f64), ("crba", 0.0), ("aba", 0.0), ("leaf_frames", 0.0)];
    let (ours, theirs) = (&ours["states"], &theirs["states"]);
    let theirs = theirs.as_array().expect("states");
    assert_eq!(ours.as_array().expect("states").len(), theirs.len());
    for (a, b) in ours.as_array().expect("states").iter().zip(theirs) {
        for (name, worst) in &mut found {
            let error = if *name == "leaf_frames" {
                frames_error(&a[*name], &b[*name])
            } else {
                relative_error(&numbers(&a[*name]), &numbers(&b[*name]))
            };
            *worst = worst.max(error);
        }
    }
    found
}

fn frames_error(ours: &Value, theirs: &Value) -> f64 {
    let theirs = theirs.as_object().expect("frames");
    let error = theirs.iter().flat_map(|(name, pose)| {
        ["rotation", "translation"].map(|part| {
            let own = &ours[name][part];
            assert!(!own.is_null(), "the frame {name} is there");
            // Rotations and metres: of order one.
            let (a, b) = (numbers(own), numbers(&pose[part]));
            a.iter().zip(b).fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()))
        })
    });
    error.fold(0.0, f64::max)
}

fn condition(states: &Value) -> f64 {
    let all = states["states"].as_array().expect("states").iter();
    all.map(|state| state["condition_of_mass_matrix"].as_f64().expect("a number"))
        .fold(0.0, f64::max)
}

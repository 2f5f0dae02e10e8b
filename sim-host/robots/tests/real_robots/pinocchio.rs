//! Kinematics and dynamics against vectors that Pinocchio made from the same files.

use crate::{condition, errors, example_robot, parse, root};
use surefoot_robots::Options;
use surefoot_robots::dynamics::{Convention, Precision, evaluate_file};

/// Vectors, robot file, and whether its mass matrix is too ill-conditioned for the tighter tolerance.
const ROBOTS: [(&str, &str); 4] = [
    ("solo12", "solo_description/robots/solo12.urdf"),
    ("panda", "panda_description/urdf/panda.urdf"),
    ("g1", "g1_description/urdf/g1_29dof_rev_1_0.urdf"),
    ("talos", "talos_data/robots/talos_full_v2.urdf"),
];

fn check(precision: Precision, tolerance: impl Fn(f64) -> f64) {
    for (name, urdf) in ROBOTS {
        let states = root().join("tests/vectors/robots").join(format!("{name}.json"));
        let convention = Convention::Pinocchio;
        let options = Options::default();
        let ours = evaluate_file(&example_robot(urdf), &states, &options, convention, precision)
            .unwrap_or_else(|error| panic!("{name}: {error}"));
        let ours = serde_json::to_value(ours).expect("JSON");
        let theirs = parse(&states);
        let limit = tolerance(condition(&theirs));
        for (what, error) in errors(&ours, &theirs) {
            println!("{name} {precision:?} {what}: {error:.1e}");
            assert!(error <= limit, "{name}: {what} is {error:e} off, {limit:e} is allowed");
        }
        let mass = |value: &serde_json::Value| value["mass"].as_f64().expect("kg");
        assert!((mass(&ours) / mass(&theirs) - 1.0).abs() < 1e-14, "{name} has its mass");
    }
}

/// Measured: below 1.5e-15 of the largest number of each result (aba of Talos 2.2e-16).
#[test]
#[ignore = "needs robot files: `cargo xtask test --only robots`"]
fn double_precision_meets_pinocchio() {
    check(Precision::F64, |_| 1e-14);
}

/// Measured: below 7e-7, whatever the condition.
#[test]
#[ignore = "needs robot files: `cargo xtask test --only robots`"]
fn single_precision_meets_pinocchio() {
    check(Precision::F32, |_| 3e-6);
}

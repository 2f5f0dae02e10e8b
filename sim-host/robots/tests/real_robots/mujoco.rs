//! Mass matrix, with rotor inertia, and bias of MJCF models against MuJoCo.

use crate::{errors, packages, parse};
use std::path::{Path, PathBuf};
use std::process::Command;
use surefoot_robots::Options;
use surefoot_robots::dynamics::{Convention, Precision, evaluate_file};

/// Relative to the largest number of each result. Measured: below 3e-14; forward dynamics of the manipulator
/// and the stacker (condition 1e6) 3e-13 and 5e-13.
const TOLERANCE: f64 = 2e-12;

/// Models that are not imported, with why.
const REFUSED: [&str; 2] = [
    // Masses from meshes.
    "dm_control/suite/dog.xml",
    // Nothing moves.
    "dm_control/suite/lqr.xml",
];

/// All models of two packages, and some larger ones.
fn models() -> Vec<PathBuf> {
    let mut found = Vec::new();
    for folder in [
        "dm_control/suite",
        "gymnasium/envs/mujoco/assets",
        "dm_control/locomotion/walkers/assets",
        "dm_control/third_party/ant",
    ] {
        let entries = std::fs::read_dir(packages().join(folder)).expect("the package's folder");
        for entry in entries {
            let path = entry.expect("an entry").path();
            if path.extension().is_some_and(|ending| ending == "xml")
                && !REFUSED.iter().any(|refused| path.ends_with(refused))
            {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

fn states_of(models: &[PathBuf], folder: &Path) -> Vec<PathBuf> {
    let python = std::env::var_os("SUREFOOT_ROBOT_PYTHON").expect("the stage sets it");
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/real_robots/mujoco_states.py");
    std::fs::create_dir_all(folder).expect("a folder below the target folder");
    let output = Command::new(python)
        .arg(script)
        .arg(folder)
        .args(models)
        .current_dir(folder)
        .output()
        .expect("Python starts");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    assert!(output.status.success(), "MuJoCo fails: {}", text(&output.stderr));
    text(&output.stdout).lines().map(|name| folder.join(format!("{name}.json"))).collect()
}

#[test]
#[ignore = "needs robot files: `cargo xtask test --only robots`"]
fn models_meet_mujoco() {
    let models = models();
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("mujoco");
    let states = states_of(&models, &folder);
    assert_eq!(states.len(), models.len());
    let mut with_rotors = 0;
    for (model, states) in models.iter().zip(states) {
        let name = model.strip_prefix(packages()).expect("in a package").display().to_string();
        let precision = Precision::F64;
        let ours =
            evaluate_file(model, &states, &Options::default(), Convention::Mujoco, precision)
                .unwrap_or_else(|error| panic!("{name}: {error}"));
        let ours = serde_json::to_value(ours).expect("JSON");
        let theirs = parse(&states);
        with_rotors += usize::from(theirs["armature"] != 0);
        for (what, error) in errors(&ours, &theirs) {
            println!("{name} {what}: {error:.1e}");
            assert!(error <= TOLERANCE, "{name}: {what} is {error:e} off");
        }
    }
    println!("{} models, {with_rotors} with rotor inertia", models.len());
    assert!(models.len() >= 35 && with_rotors >= 20, "{} models, {with_rotors}", models.len());
}

#[test]
#[ignore = "needs robot files: `cargo xtask test --only robots`"]
fn what_is_refused_says_why() {
    for (model, words) in REFUSED.iter().zip(["inertia from a mesh", "no link of it moves"]) {
        let error = surefoot_robots::import(&packages().join(model), &Options::default());
        let message = error.expect_err(model).to_string();
        assert!(message.contains(words), "{message}");
    }
}

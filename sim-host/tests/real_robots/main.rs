//! Robots of other projects stand after two commands: `cargo xtask test --only robots` installs their files.

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A URDF of example-robot-data.
fn example_robot(path: &str) -> PathBuf {
    let folder = std::env::var_os("SUREFOOT_ROBOT_FILES");
    let folder = folder.expect("`cargo xtask test --only robots` sets SUREFOOT_ROBOT_FILES");
    Path::new(&folder).join("cmeel.prefix/share/example-robot-data/robots").join(path)
}

/// What the program prints, which must succeed.
fn surefoot(folder: &Path, arguments: &[&str]) -> String {
    let program = Command::new(env!("CARGO_BIN_EXE_surefoot"));
    let output = { program }.args(arguments).current_dir(folder).output().expect("it starts");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    assert!(output.status.success(), "{}{}", text(&output.stderr), text(&output.stdout));
    text(&output.stdout)
}

fn stands(name: &str, file: &str, options: &[&str]) {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("real-robots");
    std::fs::create_dir_all(&folder).expect("a folder below the target directory");
    let file = example_robot(file);
    let import = ["import", file.to_str().expect("UTF-8"), "--out", name];
    surefoot(&folder, &[&import[..], options].concat());
    for scalar in ["f32", "f64"] {
        let (scene, out) = (format!("{name}/stand.toml"), format!("{name}-{scalar}"));
        let run = ["run", &scene, "--scalar", scalar, "--json", "--out", &out];
        let document: Value = serde_json::from_str(&surefoot(&folder, &run)).expect("JSON");
        println!("{name} in {scalar}: {} {}", document["outcome"], document["final"]);
        let off = document["final"]["position_error_m"].as_f64().expect("a number");
        // Measured: Solo12 1.4 mm, whose feet are meshes of balls, taken by their four lowest points; others
        // below 0.03 mm.
        assert!(off < if name == "solo12" { 2e-3 } else { 1e-4 }, "{name} in {scalar}: {off} m");
        assert!(document["failure"].is_null(), "{name} in {scalar}");
    }
}

/// With waist and arms moving.
#[test]
#[ignore = "needs robot files: `cargo xtask test --only robots`"]
fn g1_stands() {
    stands("g1", "g1_description/urdf/g1_29dof_rev_1_0.urdf", &[]);
}

/// On its legs of six joints alone, by the recursive controller.
#[test]
#[ignore = "needs robot files: `cargo xtask test --only robots`"]
fn g1_stands_on_its_legs_alone() {
    stands(
        "g1-legs",
        "g1_description/urdf/g1_29dof_rev_1_0.urdf",
        &["--feet", "left_ankle_roll_link,right_ankle_roll_link", "--legs-only"],
    );
}

/// Legs of five joints: soles that the controller takes for edges.
#[test]
#[ignore = "needs robot files: `cargo xtask test --only robots`"]
fn g1_stands_without_ankle_rolls() {
    stands(
        "g1-five",
        "g1_description/urdf/g1_29dof_rev_1_0.urdf",
        &["--lock", "left_ankle_roll_joint,right_ankle_roll_joint"],
    );
}

#[test]
#[ignore = "needs robot files: `cargo xtask test --only robots`"]
fn talos_stands() {
    stands("talos", "talos_data/robots/talos_reduced.urdf", &[]);
}

/// Four legs of three joints on points.
#[test]
#[ignore = "needs robot files: `cargo xtask test --only robots`"]
fn quadrupeds_stand() {
    stands("go1", "go1_description/urdf/go1.urdf", &[]);
    stands("solo12", "solo_description/robots/solo12.urdf", &[]);
}

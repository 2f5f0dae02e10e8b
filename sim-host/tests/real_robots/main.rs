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

fn stands(name: &str, file: &str) {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("real-robots");
    std::fs::create_dir_all(&folder).expect("a folder below the target directory");
    let file = example_robot(file);
    surefoot(&folder, &["import", file.to_str().expect("UTF-8"), "--out", name]);
    for scalar in ["f32", "f64"] {
        let (scene, out) = (format!("{name}/stand.toml"), format!("{name}-{scalar}"));
        let run = ["run", &scene, "--scalar", scalar, "--json", "--out", &out];
        let document: Value = serde_json::from_str(&surefoot(&folder, &run)).expect("JSON");
        println!("{name} in {scalar}: {} {}", document["outcome"], document["final"]);
        assert_eq!(document["outcome"], "balanced", "{name} in {scalar}");
    }
}

#[test]
#[ignore = "needs robot files: `cargo xtask test --only robots`"]
fn g1_stands() {
    stands("g1", "g1_description/urdf/g1_29dof_rev_1_0.urdf");
}

#[test]
#[ignore = "needs robot files: `cargo xtask test --only robots`"]
fn talos_stands() {
    stands("talos", "talos_data/robots/talos_reduced.urdf");
}

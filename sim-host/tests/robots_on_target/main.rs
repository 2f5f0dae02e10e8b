//! Robots of other projects on the emulated target: imported, built, and balanced by three commands, with the bits of
//! the host. `cargo xtask test --only firmware` installs what that needs.

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A URDF of example-robot-data.
fn example_robot(path: &str) -> PathBuf {
    let folder = std::env::var_os("SUREFOOT_ROBOT_FILES");
    let folder = folder.expect("`cargo xtask test --only firmware` sets SUREFOOT_ROBOT_FILES");
    Path::new(&folder).join("cmeel.prefix/share/example-robot-data/robots").join(path)
}

fn text(output: &Output) -> String {
    [&output.stderr, &output.stdout].map(|bytes| String::from_utf8_lossy(bytes)).concat()
}

fn surefoot(folder: &Path, arguments: &[&str]) -> Output {
    let mut program = Command::new(env!("CARGO_BIN_EXE_surefoot"));
    program.args(arguments).current_dir(folder).output().expect("it starts")
}

/// What the program prints, which must succeed.
fn said(folder: &Path, arguments: &[&str]) -> String {
    let output = surefoot(folder, arguments);
    assert!(output.status.success(), "{}", text(&output));
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// Built anew, whatever stands there.
fn firmware(folder: &Path, robot: &str) {
    let build = Command::new(env!("CARGO"))
        .args(["xtask", "firmware", "--image", "emulation", "--robot"])
        .arg(folder.join(robot))
        .current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
        .output()
        .expect("cargo starts");
    assert!(build.status.success(), "{}", text(&build));
}

/// A scene ends as it should, and every number of its record is the same on host and target.
fn is_as_on_the_host(folder: &Path, name: &str, scene: &str, outcome: &str) -> Value {
    let (host, target) = (format!("{name}-host"), format!("{name}-target"));
    said(folder, &["run", scene, "--scalar", "f32", "--out", &host]);
    let run = ["run", scene, "--controller", "firmware", "--out", &target, "--json"];
    let document: Value = serde_json::from_str(&said(folder, &run)).expect("JSON");
    println!("{name}: {} {}", document["outcome"], document["target"]);
    assert_eq!(document["outcome"], outcome);
    let record = |of: &str| told(&folder.join(of).join("record.csv"));
    assert!(record(&host) == record(&target), "the record of the target is another one");
    document["target"].clone()
}

/// A record without the columns that the link does not tell: the solver's work, and the planner's capture point.
fn told(record: &Path) -> Vec<Vec<String>> {
    let text = std::fs::read_to_string(record).expect("written");
    let mut rows = text.lines().map(|line| line.split(',').map(str::to_owned));
    let names: Vec<String> = rows.next().expect("a header").collect();
    let is_told = |name: &String| !["solver_work", "capture_x_m", "capture_y_m"].contains(&&**name);
    let all = std::iter::once(names.clone()).chain(rows.map(Iterator::collect));
    all.map(|row: Vec<String>| {
        let cells = row.into_iter().zip(&names);
        cells.filter(|(_, name)| is_told(name)).map(|(cell, _)| cell).collect()
    })
    .collect()
}

/// It stands, and every number of its record is the host's. What its ticks have cost.
fn stands(name: &str, file: &str, more: &[&str]) -> Value {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("robots-on-target");
    std::fs::create_dir_all(&folder).expect("a folder below the target directory");
    let file = example_robot(file);
    let import = ["import", file.to_str().expect("UTF-8"), "--out", name];
    said(&folder, &[&import[..], more].concat());
    firmware(&folder, &format!("{name}/robot.rs"));
    let scene = format!("{name}/stand.toml");
    let costs = is_as_on_the_host(&folder, name, &scene, "balanced");
    // The image of this robot is for no other.
    let image = format!("target/firmware/{}/emulation.elf", image_name(&folder, name));
    let image = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(image);
    let image = image.to_str().expect("UTF-8");
    let other = ["run", "--controller", "firmware", "--firmware", image, "--duration", "0.01"];
    let output = surefoot(&folder, &other);
    let said = text(&output);
    assert!(!output.status.success(), "{said}");
    assert!(said.contains("biped") && said.contains("`cargo xtask firmware`"), "{said}");
    costs
}

/// The robot's name as its robot.rs has it.
fn image_name(folder: &Path, name: &str) -> String {
    let source = std::fs::read_to_string(folder.join(name).join("robot.rs")).expect("written");
    let (_, rest) = source.split_once("pub const NAME: &str = \"").expect("it has a name");
    rest.split('"').next().expect("a string").to_owned()
}

#[test]
#[ignore = "needs robot files and the target's compiler: `cargo xtask test --only firmware`"]
fn g1_on_its_legs_stands_on_the_target() {
    stands("g1-legs", "g1_description/urdf/g1_29dof_rev_1_0.urdf", &["--legs-only"]);
}

#[test]
#[ignore = "needs robot files and the target's compiler: `cargo xtask test --only firmware`"]
fn talos_on_its_legs_stands_on_the_target() {
    stands("talos-legs", "talos_data/robots/talos_reduced.urdf", &["--legs-only"]);
}

#[test]
#[ignore = "needs robot files and the target's compiler: `cargo xtask test --only firmware`"]
fn g1_with_waist_and_arms_stands_on_the_target() {
    let costs = stands("g1", "g1_description/urdf/g1_29dof_rev_1_0.urdf", &[]);
    let budget = std::env::var("SUREFOOT_G1_INSTRUCTIONS");
    let budget = budget.expect("`cargo xtask test --only firmware` sets it");
    let budget: u64 = budget.parse().expect("a number");
    assert!(costs["max"].as_u64().expect("a number") <= budget, "{costs} > {budget}");
}

#[test]
#[ignore = "needs robot files and the target's compiler: `cargo xtask test --only firmware`"]
fn go1_stands_on_the_target() {
    stands("go1", "go1_description/urdf/go1.urdf", &[]);
}

/// The robot of the text has a file by hand, whose last module is what the program writes of other robots.
#[test]
fn the_biped_is_described_as_imported_robots_are() {
    let robot = surefoot_sim::scene::load("walk").expect("built in").robot();
    let uses = "use surefoot::model::robots::biped;\n";
    let expressions = ["biped::TREE", "biped::LIMITS"];
    let module = surefoot_sim::closed_loop::firmware::whole_body_module(&robot, uses, expressions);
    let module = module.expect("a robot with limits");
    let file = include_str!("../../../firmware/robots/biped.rs");
    assert!(file.ends_with(&module), "firmware/robots/biped.rs should end with\n{module}");
}

/// The walk on the emulated target, of the robot of the text.
#[test]
#[ignore = "needs the target's compiler: `cargo xtask test --only firmware`"]
fn the_biped_walks_on_the_target() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("robots-on-target");
    std::fs::create_dir_all(&folder).expect("a folder below the target directory");
    let build = Command::new(env!("CARGO"))
        .args(["xtask", "firmware", "--walks", "--image", "emulation"])
        .current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
        .output()
        .expect("cargo starts");
    assert!(build.status.success(), "{}", text(&build));
    is_as_on_the_host(&folder, "walk", "walk", "completed");
}

//! `robot.rs` compiles without the standard library, and is the robot that was imported.

use crate::{example_robot, root};
use std::path::Path;
use std::process::Command;
use surefoot_robots::{Options, import, robot_rs};

const MANIFEST: &str = r#"[package]
name = "firmware-robots"
version = "0.0.0"
edition = "2024"

[dependencies]
surefoot = { path = "CORE" }

[workspace]
"#;

/// Every constant in a `static`, so that the compiler evaluates all of them.
const LIBRARY: &str = r#"#![no_std]
//! Robots in flash.
pub mod g1;
pub mod panda;
pub static G1: &g1::Robot<f32> = &g1::TREE_F32;
pub static G1_LEGS: &surefoot::balance::LeggedRobot<f32, 2> = &g1::LEGGED_F32;
pub static PANDA: &panda::Robot<f32> = &panda::TREE_F32;
pub static NAMES: [&str; 13] = g1::LINK_NAMES;
pub static SOLES: [&[[f64; 3]]; 2] = g1::SOLE_POINTS;
pub const fn efforts() -> usize { g1::EFFORTS.len() + g1::RATES.len() + g1::RANGES.len() + g1::FEET.len() }
#[cfg(test)]
mod tests {
    #[test]
#[ignore = "needs robot files: `cargo xtask test --only robots`"]
    fn masses() {
        assert!((crate::g1::TREE.mass() - G1_MASS).abs() < 1e-12);
        assert!((crate::panda::TREE.mass() - PANDA_MASS).abs() < 1e-12);
        assert!((crate::G1.mass() - 33.341_14).abs() < 1e-4 && crate::efforts() == 41);
    }
}
"#;

#[test]
#[ignore = "needs robot files: `cargo xtask test --only robots`"]
fn firmware_takes_the_robots() {
    let feet = ["left_ankle_roll_link", "right_ankle_roll_link"].map(str::to_owned).to_vec();
    let legged = Options { feet, legs_only: true, ..Options::default() };
    let locks = vec![("panda_finger_joint1".to_owned(), 0.01)];
    let arm = Options { locks, base: surefoot_robots::BaseChoice::Fixed, ..Options::default() };
    let g1 = import(&example_robot("g1_description/urdf/g1_29dof_rev_1_0.urdf"), &legged);
    let panda = import(&example_robot("panda_description/urdf/panda.urdf"), &arm);
    let (g1, panda) = (g1.expect("G1").robot, panda.expect("Panda").robot);
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("firmware-robots");
    std::fs::create_dir_all(folder.join("src")).expect("a folder below the target folder");
    let core = root().join("core").canonicalize().expect("the core's folder");
    let library = LIBRARY
        .replace("G1_MASS", &format!("{:?}", g1.mass()))
        .replace("PANDA_MASS", &format!("{:?}", panda.mass()));
    for (name, text) in [
        ("Cargo.toml", MANIFEST.replace("CORE", &core.display().to_string())),
        ("src/lib.rs", library),
        ("src/g1.rs", robot_rs(&g1).expect("a tree")),
        ("src/panda.rs", robot_rs(&panda).expect("a tree")),
    ] {
        std::fs::write(folder.join(name), text).expect("written");
    }
    // The versions that the workspace has, so that nothing is downloaded.
    std::fs::copy(root().join("Cargo.lock"), folder.join("Cargo.lock")).expect("copied");
    let output = Command::new(env!("CARGO"))
        .args(["test", "--offline", "--quiet"])
        .current_dir(&folder)
        .env("CARGO_TARGET_DIR", folder.join("target"))
        .output()
        .expect("cargo starts");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "robot.rs does not compile, or is another robot:\n{said}");
}

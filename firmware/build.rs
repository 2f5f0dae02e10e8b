//! Names the robot's module, and links with cortex-m-rt's script, defmt's table of messages and the
//! board's memory map. On the host there is nothing to link.

#[path = "described_robot.rs"]
mod described_robot;

use std::env;
use std::path::PathBuf;

/// Features, as cargo tells of them, and their memory beside the workspace's `memory.x`, which is the reference
/// board's.
const BOARDS: [(&str, Option<&str>); 4] = [
    ("STM32F405", None),
    ("MPS2_AN500", Some("memory/mps2-an500.x")),
    ("MPS2_AN505", Some("memory/mps2-an505.x")),
    ("VIRT_RV32", Some("memory/virt-rv32.x")),
];

/// Set where the image is one of a robot that walks.
const WALKS: &str = "SUREFOOT_WALKS";
/// Set where the image estimates the state, and observes disturbances.
const ESTIMATES: &str = "SUREFOOT_ESTIMATES";

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let package = PathBuf::from(env::var("CARGO_MANIFEST_DIR").expect("cargo sets it"));
    let text = described_robot::leave_module(&package.join("robots/biped.rs"));
    println!("cargo::rustc-check-cfg=cfg(whole_body, walks, estimates)");
    println!("cargo::rerun-if-env-changed={WALKS}");
    let walks = env::var_os(WALKS).is_some();
    if walks {
        println!("cargo::rustc-cfg=walks");
    }
    println!("cargo::rerun-if-env-changed={ESTIMATES}");
    if env::var_os(ESTIMATES).is_some() {
        println!("cargo::rustc-cfg=estimates");
    }
    if walks || !described_robot::is_six_jointed(&text) {
        println!("cargo::rustc-cfg=whole_body");
    }
    if env::var("CARGO_CFG_TARGET_OS").as_deref() != Ok("none") {
        return;
    }
    let feature = |name: &str| env::var_os(format!("CARGO_FEATURE_{name}")).is_some();
    let Some((_, memory)) = BOARDS.into_iter().find(|(name, _)| feature(name)) else {
        println!("cargo::error=a board is needed: one of the features of Cargo.toml that are such");
        return;
    };
    let workspace = package.join("..");
    println!("cargo::rerun-if-changed={}", workspace.join("memory.x").display());
    println!("cargo::rustc-link-search={}", workspace.display());
    if let Some(memory) = memory.map(|memory| package.join(memory)) {
        println!("cargo::rerun-if-changed={}", memory.display());
        println!("cargo::rustc-link-arg-bins=-T{}", memory.display());
    }
    for argument in ["-Tlink.x", "-Tdefmt.x", "--nmagic", "--emit-relocs"] {
        println!("cargo::rustc-link-arg-bins={argument}");
    }
}

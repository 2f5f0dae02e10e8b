//! Names the robot's module, and links with cortex-m-rt's script, defmt's table of messages and the
//! board's memory map. On the host there is nothing to link.

#[path = "described_robot.rs"]
mod described_robot;

use std::env;
use std::path::PathBuf;

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
    let workspace = package.join("..");
    println!("cargo::rerun-if-changed={}", workspace.join("memory.x").display());
    println!("cargo::rustc-link-search={}", workspace.display());
    for argument in ["-Tlink.x", "-Tdefmt.x", "--nmagic", "--emit-relocs"] {
        println!("cargo::rustc-link-arg-bins={argument}");
    }
}

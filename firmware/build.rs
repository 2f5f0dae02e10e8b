//! Names the robot's module, and links with cortex-m-rt's script, defmt's table of messages and the
//! board's memory map. On the host there is nothing to link.

#[path = "described_robot.rs"]
mod described_robot;

use std::env;
use std::path::PathBuf;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let package = PathBuf::from(env::var("CARGO_MANIFEST_DIR").expect("cargo sets it"));
    // A robot that the controller for legs of six joints does not balance.
    println!("cargo::rustc-check-cfg=cfg(whole_body)");
    if described_robot::leave_module(&package.join("robots/biped.rs"))
        .contains(described_robot::WHOLE_BODY)
    {
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

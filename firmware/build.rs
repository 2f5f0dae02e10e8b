//! Names the robot's module, and links with cortex-m-rt's script, defmt's table of messages and the
//! board's memory map. On the host there is nothing to link.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};

/// The robot.rs of the robot; that of the text unless said.
const ROBOT: &str = "SUREFOOT_ROBOT";

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let package = PathBuf::from(env::var("CARGO_MANIFEST_DIR").expect("cargo sets it"));
    robot(&package);
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

/// Leaves a module that names the robot's file, so that the compiler's messages name it too.
fn robot(package: &Path) {
    println!("cargo::rerun-if-env-changed={ROBOT}");
    let file = match env::var_os(ROBOT) {
        Some(file) => PathBuf::from(file),
        None => package.join("robots/biped.rs"),
    };
    println!("cargo::rerun-if-changed={}", file.display());
    let refuse = |what: String| -> ! {
        println!("cargo::error={ROBOT}={}: {what}", file.display());
        std::process::exit(1)
    };
    let text = fs::read_to_string(&file).unwrap_or_else(|error| {
        refuse(format!("{error}; expected the robot.rs that `surefoot import` writes"))
    });
    if !text.contains("\npub mod firmware {") {
        refuse(
            "it describes no robot to the firmware, which balances a floating body on legs of six \
             revolute joints; `surefoot import` writes such a robot.rs beside a stand.toml, or says \
             why it cannot"
                .to_owned(),
        );
    }
    let path = file.canonicalize().unwrap_or_else(|error| refuse(error.to_string()));
    let module = format!("#[path = {:?}]\nmod described;\n", path.display().to_string());
    let out = PathBuf::from(env::var("OUT_DIR").expect("cargo sets it")).join("robot.rs");
    fs::write(out, module).expect("cargo's folder can be written");
}

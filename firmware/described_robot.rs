//! The robot that firmware and C library are built for, for their build scripts.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};

/// The robot.rs of the robot; that of the text unless said.
const ROBOT: &str = "SUREFOOT_ROBOT";

/// Whether the controller for legs of six joints takes the robot: its robot.rs says how many legs there are.
pub fn is_six_jointed(text: &str) -> bool {
    text.contains("pub const LEGS: usize")
}

/// Leaves a module that names the robot's file, so that the compiler's messages name it too; tells its text.
pub fn leave_module(of_the_text: &Path) -> String {
    println!("cargo::rerun-if-env-changed={ROBOT}");
    let file = match env::var_os(ROBOT) {
        Some(file) => PathBuf::from(file),
        None => of_the_text.to_owned(),
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
            "it describes no robot to the firmware; `surefoot import` writes such a robot.rs beside a \
             stand.toml, or says why it cannot"
                .to_owned(),
        );
    }
    let path = file.canonicalize().unwrap_or_else(|error| refuse(error.to_string()));
    let module = format!("#[path = {:?}]\nmod described;\n", path.display().to_string());
    let out = PathBuf::from(env::var("OUT_DIR").expect("cargo sets it")).join("robot.rs");
    fs::write(out, module).expect("cargo's folder can be written");
    text
}

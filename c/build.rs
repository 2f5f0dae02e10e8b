//! Names the robot's module, as the firmware's build script does.

#[path = "../firmware/described_robot.rs"]
mod described_robot;

use std::path::Path;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    described_robot::leave_module(Path::new("../firmware/robots/biped.rs"));
}

//! Names the robot's module, as the firmware's build script does.

#[path = "../firmware/described_robot.rs"]
mod described_robot;

use std::path::Path;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let text = described_robot::leave_module(Path::new("../firmware/robots/biped.rs"));
    if !described_robot::is_six_jointed(&text) {
        println!(
            "cargo::error=the library for C balances a floating body on legs of six revolute joints; \
             `surefoot import --legs-only` locks the joints of a robot on such legs that no foot hangs from"
        );
        std::process::exit(1);
    }
}

//! The firmware in the emulator.

use crate::arm_toolchain::ArmToolchain;
use crate::{emulator, firmware, workspace};
use anyhow::Result;

/// Builds the images and runs the tests, of the command line too, that need them.
pub fn run(arm: &ArmToolchain) -> Result<String> {
    let emulator = emulator::provide()?;
    firmware::build(arm)?;
    workspace::ignored_tests("target").run()?;
    workspace::ignored_tests("command_line").run()?;
    Ok(format!("firmware in {emulator}"))
}

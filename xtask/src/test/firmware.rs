//! The firmware in the emulator.

use super::documented;
use crate::arm_toolchain::ArmToolchain;
use crate::{emulator, firmware, workspace};
use anyhow::Result;

/// Builds the images and runs the tests, and the documents' commands, that need them.
pub fn run(arm: &ArmToolchain) -> Result<String> {
    let emulator = emulator::provide()?;
    firmware::build(arm)?;
    workspace::ignored_tests("target").run()?;
    documented::run("firmware")?;
    Ok(format!("firmware in {emulator}"))
}

//! The firmware in the emulator.

use super::robots;
use crate::toolchain::Toolchain;
use crate::{budget, emulator, firmware, workspace};
use anyhow::{Context, Result};

/// Builds the images and runs the tests, of the command line too, that need them.
pub fn run(arm: &Toolchain) -> Result<String> {
    let emulator = emulator::provide(emulator::ARM)?;
    let robot = firmware::Robot::of_the_text()?;
    firmware::build(arm, &robot)?;
    firmware::build_variants(arm)?;
    firmware::build_for_other_chips(&robot)?;
    workspace::ignored_tests("target").run()?;
    workspace::ignored_tests("command_line").run()?;
    // These build firmware for robots of other projects.
    let most = budget::limits(arm)?.g1_stand_instructions.to_string();
    let tests = workspace::ignored_tests("robots_on_target").env("SUREFOOT_G1_INSTRUCTIONS", most);
    robots::files()?.given_to(tests).run().context(
        "a robot of another project fails on the target, as is said above under its name",
    )?;
    Ok(format!("firmware in {emulator}"))
}

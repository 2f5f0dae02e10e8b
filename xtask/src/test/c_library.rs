//! The controller as a library for C.

use crate::firmware::Robot;
use crate::toolchain::TARGET;
use crate::{c_library, workspace};
use anyhow::{Context, Result};

/// A program of C, compiled and run on this machine.
pub fn run() -> Result<String> {
    c_library::build(&Robot::of_the_text()?, None)?;
    workspace::ignored_tests("c_program")
        .run()
        .context("a program of C fails, as is said above; a compiler `cc` is needed for it")?;
    Ok("a program of C, with the core's bits".to_owned())
}

/// The archive for the target.
pub fn on_target() -> Result<String> {
    let files = c_library::build(&Robot::of_the_text()?, Some(TARGET))?;
    Ok(format!("{} files for {TARGET}", files.len()))
}

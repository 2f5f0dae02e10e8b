//! The controller as a library for C.

use crate::firmware::Robot;
use crate::tool::Tool;
use crate::toolchain::TARGET;
use crate::{c_library, emulator, workspace};
use anyhow::{Context, Result};

const COMPILER: Tool = Tool {
    program: "arm-none-eabi-gcc",
    package: "gcc-arm-none-eabi",
    folder: "c-tools",
    arguments: "",
    kept: KEPT,
};
const CMAKE: Tool =
    Tool { program: "cmake", package: "cmake", folder: "c-tools", arguments: "", kept: KEPT };
const KEPT: &[&str] = &["arm-none-eabi-", "cmake"];

/// A program of C, compiled and run on this machine.
pub fn run() -> Result<String> {
    c_library::build(&Robot::of_the_text()?, None)?;
    workspace::ignored_tests("c_program")
        .run()
        .context("a program of C fails, as is said above; a compiler `cc` is needed for it")?;
    Ok("a program of C, with the core's bits".to_owned())
}

/// The archive for the target, and a program of C for it where its compiler can be had.
pub fn on_target() -> Result<String> {
    let files = c_library::build(&Robot::of_the_text()?, Some(TARGET))?;
    let archive = format!("{} files for {TARGET}", files.len());
    let tools = [emulator::ARM, CMAKE, COMPILER].map(|tool| tool.provide());
    let [qemu, cmake, compiler] = match tools {
        [Ok(qemu), Ok(cmake), Ok(compiler)] => [qemu, cmake, compiler],
        tools => {
            // The archive is what ships; a machine without these tools can still make it.
            let missing =
                tools.into_iter().filter_map(Result::err).map(|error| format!("{error:#}"));
            let missing = missing.collect::<Vec<_>>().join("; ");
            return Ok(format!("{archive}; no program of C was built with them: {missing}"));
        }
    };
    workspace::ignored_tests("bare_metal")
        .env("SUREFOOT_QEMU_ARM", qemu)
        .env("SUREFOOT_CMAKE", cmake)
        .env("SUREFOOT_ARM_CC", compiler)
        .run()
        .context("a program of C for the target fails, as is said above")?;
    Ok(format!("{archive}; an interrupt of C in QEMU, with the core's bits"))
}

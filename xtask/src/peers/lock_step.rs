//! `cargo xtask peers --lock-step`: the firmware in QEMU, stepped by MuJoCo over the link, and the host's library beside
//! it on the same measurements: equal bits at every tick.

use super::RUN_LIMIT;
use crate::firmware::{self, Robot};
use crate::step::Step;
use crate::workspace::Built;
use crate::{c_library, emulator, workspace};
use anyhow::{Context, Result};
use std::path::Path;

/// Of the scene `stand`, with the robot of the text.
pub fn run(folder: &Path, python: &Path) -> Result<()> {
    let robot = Robot::of_the_text()?;
    let files = c_library::build(&robot, None)?;
    let library = files
        .iter()
        .find(|path| path.extension().is_some_and(|end| end == "so" || end == "dylib"))
        .context("a shared library")?;
    let image = firmware::build_emulation(&robot)?;
    let qemu = emulator::ARM.provide()?;
    let program = workspace::example("peers_loop", Built::WithTests)?;
    let document = Step::new(program, ["stand", "model"]).run_and_read()?;
    let model = folder.join("lock-step.json");
    std::fs::write(&model, document)
        .with_context(|| format!("cannot write {}", model.display()))?;
    let script = workspace::root().join("tests/peers/lock_step.py");
    let run = Step::new(python, [&script, &qemu, &image, library, &model]);
    println!("{}", run.within(RUN_LIMIT).run_and_read()?);
    Ok(())
}

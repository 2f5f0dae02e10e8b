//! `surefoot count-steps`: what `chart parsimony` runs under callgrind.

use super::{RUN_FAILED, bad_input};
use crate::parsimony::Rung;
use crate::scene::load;
use clap::Parser;
use std::num::NonZeroUsize;
use std::process::ExitCode;

/// Options of `count-steps`.
#[derive(Debug, Parser)]
pub struct Options {
    /// A robot's scene
    scene: String,
    /// The model
    #[arg(value_enum)]
    rung: Rung,
    /// How many copies of it make every step
    copies: NonZeroUsize,
    /// Simulated seconds, instead of the scene's
    #[arg(long)]
    duration: Option<f64>,
}

/// Plays the motion and says nothing.
pub fn count_steps(options: &Options) -> ExitCode {
    let scene = load(&options.scene).and_then(|mut scene| {
        scene.duration_s = options.duration.unwrap_or(scene.duration_s);
        scene.check().map(|()| scene)
    });
    let scene = match scene {
        Ok(scene) => scene,
        Err(error) => return bad_input(&error.to_string(), false),
    };
    match options.rung.play(&scene, options.copies) {
        Ok(_) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("failed: {failure}");
            ExitCode::from(RUN_FAILED)
        }
    }
}

//! `surefoot count-steps`: what `chart parsimony` runs under callgrind.

use super::{RUN_FAILED, bad_input, complain};
use crate::parsimony::{MechanismRung, PlayFailure, Played, Rung};
use clap::{Parser, ValueEnum};
use std::num::NonZeroUsize;
use std::process::ExitCode;
use surefoot_sim::scene::{AnyScene, open};

/// Options of `count-steps`.
#[derive(Debug, Parser)]
pub struct Options {
    /// A scene
    scene: String,
    /// The model: a robot's, or one of bodies and joints
    rung: String,
    /// How many copies of it make every step
    copies: NonZeroUsize,
    /// Simulated seconds, instead of the scene's
    #[arg(long)]
    duration: Option<f64>,
}

/// Plays the motion and says nothing.
pub fn count_steps(options: &Options) -> ExitCode {
    match play(options) {
        Err(message) => bad_input(&message, false),
        Ok(Ok(_)) => ExitCode::SUCCESS,
        Ok(Err(failure)) => {
            complain(format_args!("failed: {failure}"));
            ExitCode::from(RUN_FAILED)
        }
    }
}

fn play(options: &Options) -> Result<Result<Played, PlayFailure>, String> {
    let duration_s = |of_scene: f64| options.duration.unwrap_or(of_scene);
    match open(&options.scene).map_err(|error| error.to_string())? {
        AnyScene::Robot(mut scene) => {
            scene.duration_s = duration_s(scene.duration_s);
            scene.check().map_err(|error| error.to_string())?;
            Ok(Rung::from_str(&options.rung, false)?.play(&scene, options.copies))
        }
        AnyScene::Mechanism(mut scene) => {
            scene.duration_s = duration_s(scene.duration_s);
            scene.check().map_err(|error| error.to_string())?;
            Ok(MechanismRung::from_str(&options.rung, false)?.play(&scene, options.copies))
        }
    }
}

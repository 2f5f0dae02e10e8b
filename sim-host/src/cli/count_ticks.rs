//! `surefoot count-ticks`: what `chart work-precision` runs under callgrind.

use super::bad_input;
use crate::precision::{ControllerForm, pass, read_states};
use clap::Parser;
use std::path::PathBuf;
use std::process::ExitCode;
use surefoot_sim::scene::load;

/// Options of `count-ticks`.
#[derive(Debug, Parser)]
pub struct Options {
    /// States of Experiment 1
    states: PathBuf,
    #[command(flatten)]
    form: ControllerForm,
    /// How often it goes through them
    #[arg(long)]
    passes: u32,
}

/// Makes the ticks and says nothing.
pub fn count_ticks(options: &Options) -> ExitCode {
    let states = read_states(&options.states)
        .map_err(|error| format!("{}: {error}", options.states.display()));
    let scene = load("experiment-1").map_err(|error| error.to_string());
    match states.and_then(|states| Ok((states, scene?))) {
        Ok((states, scene)) => {
            pass(options.form.controller(&scene).as_mut(), &states, options.passes);
            ExitCode::SUCCESS
        }
        Err(message) => bad_input(&message, false),
    }
}

//! Runs of mechanisms that nobody controls (chapter 2), under any method.

mod moving;
mod run;

pub use moving::{Moving, StartFailure, start, start_bodies};
pub use run::{MechanismRun, MechanismSample, run, run_from};

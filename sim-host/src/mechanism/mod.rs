//! Runs of mechanisms that nobody controls (chapter 2), under any method.

mod composed;
mod merged;
mod moving;
mod run;
mod start;
mod tree;

pub use moving::Moving;
pub use run::{MechanismRun, MechanismSample, run, run_from};
pub use start::{StartFailure, start, start_bodies, start_within};

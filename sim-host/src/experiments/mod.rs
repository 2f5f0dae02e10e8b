//! What the dissertation prints about its experiments, beside what a run gives.

pub mod box_drop;
mod comparison;
pub mod double_pendulum;
mod experiment_1;
mod figure;
pub mod free_body;
mod samples;

pub use comparison::{Asked, Comparison};
pub use experiment_1::experiment_1;
pub use figure::Figure;

use crate::closed_loop::Run;

/// The printed figures of a scene, if the text has it.
pub fn printed_figures(scene: &str, run: &Run) -> Vec<Comparison> {
    match scene {
        "experiment-1" | "experiment-1-welded" => experiment_1(run),
        _ => Vec::new(),
    }
}

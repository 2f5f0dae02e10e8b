//! What the dissertation prints about its experiments, beside what a run gives.

pub mod box_drop;
mod comparison;
pub mod double_pendulum;
mod experiment_1;
mod experiment_2;
mod figure;
mod foot_events;
pub mod free_body;
pub mod robot_figures;
mod samples;

pub use comparison::{Asked, Comparison};
pub use experiment_1::experiment_1;
pub use experiment_2::experiment_2;
pub use figure::Figure;

use surefoot_sim::closed_loop::Run;
use surefoot_sim::scene::TorquesFrom;

/// The printed figures of a scene, if the text has it.
pub fn printed_figures(scene: &str, run: &Run) -> Vec<Comparison> {
    match scene {
        "experiment-1" | "experiment-1-welded" => experiment_1(run),
        "experiment-2" => experiment_2(run),
        _ => Vec::new(),
    }
}

/// How the first instant is read, which the text leaves open.
pub fn reading(from: TorquesFrom) -> &'static str {
    match from {
        TorquesFrom::Start => "torques from t = 0",
        TorquesFrom::TouchDown => "torques from touch-down",
    }
}

//! What the dissertation prints about its experiments, beside what a run gives.

mod experiment_1;

pub use experiment_1::experiment_1;

use crate::closed_loop::Run;
use serde::Serialize;

/// One printed figure and ours.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Comparison {
    /// What is compared.
    pub figure: String,
    /// Unit.
    pub unit: &'static str,
    /// What the run gives.
    pub ours: f64,
    /// What the text prints.
    pub printed: f64,
    /// `ours/printed − 1`.
    pub relative_difference: f64,
}

impl Comparison {
    fn new(figure: impl Into<String>, unit: &'static str, ours: f64, printed: f64) -> Self {
        let relative_difference = ours / printed - 1.0;
        Self { figure: figure.into(), unit, ours, printed, relative_difference }
    }
}

/// The printed figures of a scene, if the text has it.
pub fn printed_figures(scene: &str, run: &Run) -> Vec<Comparison> {
    match scene {
        "experiment-1" | "experiment-1-welded" => experiment_1(run),
        _ => Vec::new(),
    }
}

//! What the dissertation prints about its experiments, beside what a run gives.

mod experiment_1;
mod table_2_1;
mod table_2_2;

pub use experiment_1::experiment_1;
pub use table_2_1::table_2_1;
pub use table_2_2::table_2_2;

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
    /// `ours/printed − 1`; of no meaning where zero is printed.
    pub relative_difference: Option<f64>,
}

impl Comparison {
    fn new(figure: impl Into<String>, unit: &'static str, ours: f64, printed: f64) -> Self {
        let relative_difference = (printed != 0.0).then(|| ours / printed - 1.0);
        Self { figure: figure.into(), unit, ours, printed, relative_difference }
    }
}

/// The error of (2.53) and (2.56): mean distance of two series of vectors, divided by their length.
fn mean_distance<'a, const M: usize>(
    pairs: impl Iterator<Item = (&'a [f64; M], &'a [f64; M])>,
) -> f64 {
    let (mut sum, mut count) = (0.0, 0);
    for (a, b) in pairs {
        sum += a.iter().zip(b).map(|(x, y)| (x - y) * (x - y)).sum::<f64>().sqrt();
        count += 1;
    }
    sum / (count * M) as f64
}

/// The printed figures of a scene, if the text has it.
pub fn printed_figures(scene: &str, run: &Run) -> Vec<Comparison> {
    match scene {
        "experiment-1" | "experiment-1-welded" => experiment_1(run),
        _ => Vec::new(),
    }
}

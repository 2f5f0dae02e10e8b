//! One figure of the text, drawn again.

use super::comparison::Comparison;
use crate::chart::XyChart;

/// A figure.
pub struct Figure {
    /// Its name on the command line.
    pub name: &'static str,
    /// How it is read.
    pub reading: &'static str,
    /// The drawing.
    pub chart: XyChart,
    /// What can be compared in numbers.
    pub rows: Vec<Comparison>,
}

/// A chart of something against the step, both on logarithmic axes.
pub(super) fn against_step(title: impl Into<String>, axis: &str) -> XyChart {
    XyChart::new(title, "step h (s)", axis).logarithmic()
}

//! Charts as SVG.

mod run_charts;
mod time_series;

pub use run_charts::write_charts;
pub use time_series::{ChartError, Panel, Series, draw};

//! Charts as SVG.

mod run_charts;
mod style;
mod time_series;
mod xy;

pub use run_charts::write_charts;
pub use style::ChartError;
pub use time_series::{Panel, Series, draw};
pub use xy::{XyChart, XySeries};

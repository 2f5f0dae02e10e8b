//! Charts as SVG.

mod bars;
mod mechanism_charts;
mod run_charts;
mod style;
mod time_series;
mod xy;

pub use bars::{Bar, Bars};
pub use mechanism_charts::write_mechanism_chart;
pub use run_charts::write_charts;
pub use style::ChartError;
pub use time_series::{Panel, Series, draw};
pub use xy::{XyChart, XySeries};

//! Charts as SVG.

mod axes;
mod bars;
mod heat_map;
mod log_log;
mod marks;
mod mechanism_figures;
mod run_figures;
mod style;
mod time_series;
mod xy;

pub use bars::{Bar, Bars};
pub use heat_map::{CellAxis, CellKind, CellLine, HeatMap};
pub use log_log::{LogLogChart, MarkedCurve};
pub use marks::marks;
pub use mechanism_figures::{MECHANISM_FIGURES, MechanismFigure};
pub use run_figures::{RUN_FIGURES, RunFigure};
pub use style::ChartError;
pub use time_series::{Mark, Panel, Series, TimeSeries};
pub use xy::{XyChart, XySeries};

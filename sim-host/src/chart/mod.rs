//! Charts as SVG.

mod heat_map;
mod marks;
mod mechanism_charts;
mod run_figures;
mod style;
mod time_series;
mod xy;

pub use heat_map::{CellAxis, CellKind, CellLine, HeatMap};
pub use marks::marks;
pub use mechanism_charts::write_mechanism_chart;
pub use run_figures::{RUN_FIGURES, RunFigure};
pub use style::{ChartError, OKABE_ITO};
pub use time_series::{Mark, Panel, Series, TimeSeries};
pub use xy::{XyChart, XySeries};

//! The report of a robot's run: one page that needs nothing else, with a replay.

mod page;
mod replay_data;
mod stability_page;
mod tables;

pub use page::{PageFailure, Report, page};
pub use stability_page::{ForecastCounts, MapFigure, StepRow, StepTable, stability_page};

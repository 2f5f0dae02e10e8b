//! Pages that need nothing but themselves: the report of a robot's run, with a replay, and the charts.

mod charts_page;
mod page;
mod plain_chapter;
mod replay_data;
mod stability_chapter;
mod tables;

pub use charts_page::{Chapter, Figure, charts_page};
pub use page::{PageFailure, Report, page};
pub use plain_chapter::{Table, plain_chapter};
pub use stability_chapter::{ForecastCounts, StepRow, StepTable, stability_chapter};

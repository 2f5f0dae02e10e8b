//! Pages that need nothing but themselves: the report of a run, with a replay, and the charts.

mod benchmarks_page;
mod certificate_page;
mod charts_page;
mod mechanism_page;
mod page;
mod plain_chapter;
mod replay_data;
mod robot_page;
mod stability_chapter;
mod tables;

pub use benchmarks_page::{PageError, benchmarks_page};
pub use certificate_page::{CertificateFailure, certificate_page};
pub use charts_page::{Chapter, Figure, charts_page};
pub use mechanism_page::{MechanismReport, mechanism_page};
pub use page::PageFailure;
pub use plain_chapter::{Table, plain_chapter};
pub use robot_page::{Report, page};
pub use stability_chapter::{ForecastCounts, StepRow, StepTable, stability_chapter};

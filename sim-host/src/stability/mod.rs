//! How long a step may be: for each method and problem the steps at which it works, how it fails
//! beyond, and what was foretold.

mod catalogue;
mod forecast;
pub mod loop_limits;
mod problem;
mod scan;
mod verdict;

pub use catalogue::problems;
pub use forecast::{Rates, forecast};
pub use problem::Problem;
pub use scan::{Limit, Scan, scan, scan_one};
pub use verdict::{FailureKind, Verdict};

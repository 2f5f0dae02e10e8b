//! How long a step may be: for each method and problem the steps at which it works, how it fails
//! beyond, and what was foretold.

mod catalogue;
pub mod loop_limits;
pub mod maps;
mod problem;
mod scan;
mod standing;
mod store;
mod tally;
mod tree_catalogue;
mod trees;

pub use catalogue::problems;
pub use problem::Problem;
pub use scan::{Agreement, Limit, RATIO, Scan, all_problems, scan_one, scan_problems};
pub use standing::standing;
pub use store::{MapStore, PartStoreError, Parts, ScanStore};
pub use tally::Tally;
pub use tree_catalogue::{TreeProblemError, floating_chain, motion_of, tree_problems};
pub use trees::TreeMotion;

//! Public benchmark problems of multibody dynamics, against references that no one here wrote.
//!
//! Definitions: IFToMM's library of computational benchmark problems (A01 to A05, bicycle), the IVP test set (Andrews'
//! mechanism), Gazebo's boxes (scpeters/benchmark), Drake's baby boot, the heavy top of Terze 2016, and SimBenchmark.
//! References: `benchmarks/references.json`, with the source of each.

mod boxes;
mod peers;
mod play;
mod problems;
mod references;
mod row;
mod table;
#[cfg(test)]
mod tests;

pub use play::{Played, Trace};
pub use problems::{Benchmark, Measure, all, scene};
pub use row::{Advised, Effort, Peer, Row, rows};
pub use table::{iftomm_text, table};

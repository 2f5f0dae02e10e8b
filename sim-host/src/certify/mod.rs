//! How often a controller fails, how sure that is, and what makes it fail.
//!
//! ```text
//! scene, vary file ─► Study ─► samples (Sobol) ─► scenes ─► runs ─► table of rows ─► Certificate
//! ```
//! A sample is decided by the study and its number alone: results do not depend on how many processors, machines or
//! shards have shared the work, and a study that was broken off goes on to the same table.

mod binomial;
mod certificate;
mod cross_entropy;
mod distribution;
mod margins;
mod normal;
mod path;
mod row;
mod search;
mod sensitivity;
mod sequence;
mod study;
mod support;
mod table;
mod vary;
mod weighted;
mod workers;

pub use binomial::{Interval, clopper_pearson};
pub use certificate::{
    Certificate, Deciding, MarginSummary, Mode, Nearest, Searched, Share, TargetRuns, Varied,
    nearest, percent,
};
pub use cross_entropy::{Batches, Effort, Found, FoundFailure, Proposal, Round, in_cube, search};
pub use distribution::Distribution;
pub use margins::{CARRIES, MARGINS, Margins};
pub use normal::{ordinary, quantile};
pub use path::{FieldPath, PathError};
pub use row::{Row, bits};
pub use search::search_failures;
pub use sensitivity::{Pair, Sensitivities, sensitivities};
pub use sequence::{MOST_COORDINATES, Sampling, Stream, generator, point};
pub use study::{Coordinate, Definition, Study, StudyError};
pub use table::{CONTENTS, Contents, Folder, RUNS, Rows, Shard, merge};
pub use vary::{Parameter, Require, Vary, VaryError};
pub use weighted::weighted_interval;
pub use workers::{all_processors, on_all};

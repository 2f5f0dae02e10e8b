//! How long the steps of a method may be, predicted: at a state, and along a motion.

mod along;
mod course;
mod local;
mod verdict;

pub use along::{RANGE_S, bounds, foretell};
pub use course::Course;
pub use local::{
    Change, FEW_STEPS, Forecast, Probe, SHARE, SHARE_OF_LOSSES, has_modified_energy,
    oscillation_limit,
};
pub use verdict::{Bounds, FailureKind, Verdict, attempt};

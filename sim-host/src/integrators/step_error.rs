//! Why a step could not be made, which one, and when.

use crate::newton::NewtonFailure;

/// A step that could not be made.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("step {step} of {h} s, at {time_s} s: {failure}")]
pub struct StepError {
    /// Number of the step.
    pub step: u64,
    /// Its length, s.
    pub h: f64,
    /// When, s.
    pub time_s: f64,
    /// Why.
    pub failure: NewtonFailure,
}

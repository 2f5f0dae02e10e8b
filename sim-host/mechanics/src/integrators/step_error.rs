//! Why a step could not be made, which one, and when.

use crate::newton::NewtonFailure;
use surefoot::dynamics::DynamicsFault;

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
    pub failure: StepFailure,
}

/// Why a step could not be made.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum StepFailure {
    /// Its equations have not been solved.
    #[error("{0}")]
    Newton(#[from] NewtonFailure),
    /// Its equations have a root, but one that no shorter step leads to: there is a fold between. A
    /// motion that went on from it would be another one.
    #[error("the step is too long: its root is on another branch than that of short steps")]
    WrongBranch,
    /// Too many steps had to be made in shorter ones: those spoil what the method conserves.
    #[error("the step is too long: {splits} steps so far had to be made in shorter ones")]
    TooManySplits {
        /// How many.
        splits: u64,
    },
    /// A gimbal's motors have come within 5° of lock: their torques would grow beyond bounds.
    #[error("the gimbal of joint {joint} is within 5 degrees of lock")]
    GimbalLock {
        /// Its link.
        joint: usize,
    },
    /// The adaptive method's own steps have become too short or too many.
    #[error("the adaptive method cannot meet its tolerance")]
    Adaptive,
    /// The equations of motion have no solution.
    #[error("{0}")]
    Dynamics(#[from] DynamicsFault),
}

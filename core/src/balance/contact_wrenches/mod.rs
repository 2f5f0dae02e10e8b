//! Foot wrenches within limits: Algorithm 4.5 as a quadratic program.

mod foot;
mod metric;
mod program;
mod relief;
mod rows;

pub use foot::{ContactFoot, ContactLimits, ContactPatch};
pub use program::ContactProgram;
pub use relief::Reason;
pub use rows::ContactLimit;

use crate::Real;

/// What the split of a wrench is measured by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactWeights<T> {
    /// `ω`: weights of the wrench's error in world axes, force (1/N) before moment (1/(N·m)).
    pub task: [T; 6],
    /// `ε`: weight of the distance from the least-norm split.
    pub regularization: T,
    /// `ℓ`, m: a moment counts as a force at this length.
    pub norm_length: T,
}

impl<T: Real> ContactWeights<T> {
    /// Vertical force and tilt first, a moment counted with 1/(0.1 … 0.2 m); ε = 0.01; ℓ = 0.1 m, half
    /// a sole, which shifts load between the feet before it tips one.
    pub fn standing() -> Self {
        Self {
            task: [1.0, 1.0, 2.0, 10.0, 10.0, 4.0].map(T::of),
            regularization: T::of(0.01),
            norm_length: T::of(0.1),
        }
    }
}

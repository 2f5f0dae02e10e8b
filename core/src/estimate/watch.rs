//! From doubts of single ticks to a reason to stop.
//!
//! ```text
//! d ← max(0, d − h/2)   in a tick with nothing out of bounds;   d ← d + h   in one with something     (1)
//! ```
//! A foot that lands hard, or rolls over its edge, is off for some ticks; one that slips, a filter that was started
//! wrong or a sensor that breaks is so for good. With feet in turn a doubtful foot shows in every second tick, for which
//! (1) forgets half as fast as it learns. Bounds that are times already (switches, no foot on the ground) stop at once.

use super::{Concern, Health};
use crate::Real;

/// How long something may be out of bounds, s.
const PATIENCE: f64 = 0.1;

/// What has become of the estimate's health over time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EstimateWatch<T> {
    /// `d`, s.
    pub doubted: T,
}

impl<T: Real> EstimateWatch<T> {
    /// Nothing was doubted yet.
    pub fn new() -> Self {
        Self { doubted: T::zero() }
    }

    /// After another tick of `period` seconds: what the robot is to be stopped for
    /// ([`StopReason::Estimate`](crate::balance::StopReason::Estimate)), if it is.
    #[inline]
    pub fn after(&mut self, health: &Health<T>, period: T) -> Option<Concern> {
        let Some(worst) = &health.worst else {
            self.doubted = (self.doubted - period * T::of(0.5)).max(T::zero());
            return None;
        };
        self.doubted += period;
        let is_time =
            matches!(worst.concern, Concern::Switch(_) | Concern::Airborne | Concern::Covariance);
        (is_time || self.doubted > T::of(PATIENCE)).then_some(worst.concern)
    }
}

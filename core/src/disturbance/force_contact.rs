//! Which feet touch the ground, by what their legs' joints feel.
//!
//! # Limits
//! Where joints have no dry friction, a touch-down is seen within 12 ms. Friction that is not known reads as
//! force: with 2 N·m in the joints of a robot of 75 kg a touch-down is seen as much as 50 ms late, and a
//! filter that believes it loses its state. So this is a check on foot switches, and no replacement of them.

use super::FootForce;
use crate::Real;

/// Vertical forces from which on a foot touches, and below which it does not, N.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForceThresholds<T> {
    /// A foot in the air touches from here on.
    pub on: T,
    /// A foot that touches lifts below this.
    pub off: T,
}

impl<T: Real> ForceThresholds<T> {
    /// Documented starting values for a weight (N): 0.11 and 0.04 of it (80 N and 30 N for 75 kg).
    pub fn scaled(weight: T) -> Self {
        Self { on: weight * T::of(0.11), off: weight * T::of(0.04) }
    }
}

/// The feet that touch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ForceContact<const FEET: usize> {
    /// By foot.
    pub touches: [bool; FEET],
}

impl<const FEET: usize> ForceContact<FEET> {
    /// All of them.
    pub fn new() -> Self {
        Self { touches: [true; FEET] }
    }

    /// After another tick. A foot of which nothing is known stays as it is.
    #[inline(always)]
    pub fn update<T: Real>(
        &mut self,
        thresholds: &ForceThresholds<T>,
        feet: &[Option<FootForce<T>>; FEET],
    ) {
        for (touches, foot) in self.touches.iter_mut().zip(feet) {
            if let Some(FootForce { wrench, .. }) = foot {
                let from = if *touches { thresholds.off } else { thresholds.on };
                *touches = wrench.force.z > from;
            }
        }
    }
}

impl<const FEET: usize> Default for ForceContact<FEET> {
    fn default() -> Self {
        Self::new()
    }
}

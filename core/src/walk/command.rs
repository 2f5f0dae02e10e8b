//! What a user asks of a walk.

use super::bounded::bounded;
use super::{Gait, WalkFault, WalkInput};
use crate::Real;
use nalgebra::Vector2;

/// A walk's motion in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneMotion<T> {
    /// Forward and to the left, m/s.
    pub velocity: Vector2<T>,
    /// To the left, rad/s.
    pub turning_rate: T,
}

/// What the robot is to do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WalkCommand<T> {
    /// How it is to walk; none: it is to stand.
    pub walk: Option<PlaneMotion<T>>,
    /// How far below its standing height, m.
    pub lowered: T,
}

impl<T: Real> PlaneMotion<T> {
    /// No motion: stepping in place.
    pub fn in_place() -> Self {
        Self { velocity: Vector2::zeros(), turning_rate: T::zero() }
    }

    /// After a tick of `dt` seconds of going towards `wanted`, no faster than a gait's accelerations allow.
    pub(super) fn approached(&self, wanted: &Self, gait: &Gait<T>, dt: T) -> Self {
        let toward = |from: T, to: T, most: T| from + bounded(to - from, -most * dt, most * dt);
        let [linear, angular] = gait.command_accelerations;
        Self {
            velocity: self.velocity.zip_map(&wanted.velocity, |x, to| toward(x, to, linear)),
            turning_rate: toward(self.turning_rate, wanted.turning_rate, angular),
        }
    }
}

impl<T: Real> WalkCommand<T> {
    /// To stand upright.
    pub fn stand() -> Self {
        Self { walk: None, lowered: T::zero() }
    }

    /// To walk at full height.
    pub fn walk(velocity: Vector2<T>, turning_rate: T) -> Self {
        Self { walk: Some(PlaneMotion { velocity, turning_rate }), lowered: T::zero() }
    }

    pub(super) fn check(&self) -> Result<(), WalkFault> {
        let numbers = self
            .walk
            .map_or(T::zero(), |walk| walk.velocity.x + walk.velocity.y + walk.turning_rate);
        if (numbers + self.lowered).is_finite() {
            return Ok(());
        }
        Err(WalkFault::NotFinite(WalkInput::Command))
    }
}

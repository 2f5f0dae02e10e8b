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

/// A jump on the spot, or several.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JumpOrder<T> {
    /// By how much the centre of mass is to rise after take-off, m.
    pub rise: T,
    /// How many, one after the other.
    pub hops: u8,
    /// An order is followed once: another number is another order.
    pub number: u8,
}

/// What the robot is to do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WalkCommand<T> {
    /// How it is to walk; none: it is to stand.
    pub walk: Option<PlaneMotion<T>>,
    /// Whether it runs instead: both sides in the air between two stances.
    pub runs: bool,
    /// What it does as soon as it stands and is not to walk.
    pub jump: Option<JumpOrder<T>>,
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
        Self { walk: None, runs: false, jump: None, lowered: T::zero() }
    }

    /// To walk at full height.
    pub fn walk(velocity: Vector2<T>, turning_rate: T) -> Self {
        Self { walk: Some(PlaneMotion { velocity, turning_rate }), ..Self::stand() }
    }

    /// To run.
    pub fn run(velocity: Vector2<T>, turning_rate: T) -> Self {
        Self { runs: true, ..Self::walk(velocity, turning_rate) }
    }

    /// To jump once, so that the centre of mass rises by `rise` (m) after take-off, and to stand.
    pub fn jump(rise: T, number: u8) -> Self {
        Self { jump: Some(JumpOrder { rise, hops: 1, number }), ..Self::stand() }
    }

    pub(super) fn check(&self) -> Result<(), WalkFault> {
        let numbers = self
            .walk
            .map_or(T::zero(), |walk| walk.velocity.x + walk.velocity.y + walk.turning_rate);
        let rise = self.jump.map_or(T::zero(), |jump| jump.rise);
        if (numbers + self.lowered + rise).is_finite() {
            return Ok(());
        }
        Err(WalkFault::NotFinite(WalkInput::Command))
    }
}

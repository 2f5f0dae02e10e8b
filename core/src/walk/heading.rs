//! Turns about the vertical.

use crate::Real;
use nalgebra::{Matrix3, Vector2};

/// The heading frame's axes in the world's plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Heading<T> {
    cosine: T,
    sine: T,
}

impl<T: Real> Heading<T> {
    /// Its forward axis at this angle from the world's x, rad.
    pub fn new(angle: T) -> Self {
        let (sine, cosine) = angle.sine_cosine();
        Self { cosine, sine }
    }

    /// Forward and left to x and y.
    pub fn to_world(self, v: Vector2<T>) -> Vector2<T> {
        Vector2::new(self.cosine * v.x - self.sine * v.y, self.sine * v.x + self.cosine * v.y)
    }

    /// x and y to forward and left.
    pub fn of_world(self, v: Vector2<T>) -> Vector2<T> {
        Vector2::new(self.cosine * v.x + self.sine * v.y, self.cosine * v.y - self.sine * v.x)
    }
}

/// Angle of a frame's first axis in the plane, rad.
pub(super) fn yaw<T: Real>(rotation: &Matrix3<T>) -> T {
    rotation.m21.atan2(rotation.m11)
}

/// The same angle within half a turn of zero. Exact where it is there already.
pub(super) fn wrapped<T: Real>(angle: T) -> T {
    let turns = ((angle + T::pi()) / T::two_pi()).floor();
    angle - turns * T::two_pi()
}

//! Where one body's frame is in another's.

use super::super::BodyState;
use nalgebra::Vector3;
use surefoot::spatial::Quaternion;

/// A body's frame, seen from another's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Of its origin, m.
    pub position: Vector3<f64>,
    /// Of its axes, of unit norm.
    pub orientation: Quaternion<f64>,
}

impl Frame {
    /// The same frame.
    pub const IDENTITY: Self = Self {
        position: Vector3::new(0.0, 0.0, 0.0),
        orientation: Quaternion { s: 1.0, v: Vector3::new(0.0, 0.0, 0.0) },
    };

    /// A frame that is seen from this one, seen from where this one is seen from.
    #[must_use]
    pub fn then(&self, next: &Self) -> Self {
        Self {
            position: self.point(next.position),
            orientation: self.orientation.product(next.orientation),
        }
    }

    /// The other frame, seen from this one.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let orientation = self.orientation.conjugate();
        Self { position: -orientation.rotate(self.position), orientation }
    }

    /// A point of this frame, in the other's coordinates.
    pub fn point(&self, point: Vector3<f64>) -> Vector3<f64> {
        self.position + self.orientation.rotate(point)
    }

    /// Whether its axes are the other's.
    pub fn is_parallel(&self) -> bool {
        self.orientation.v == Vector3::zeros()
    }

    /// State and rate of this frame, which is fixed in a body of state `x` and rate `v`.
    pub(super) fn carried(&self, x: &BodyState, v: &BodyState) -> (BodyState, BodyState) {
        let q = Quaternion::from_array([x[3], x[4], x[5], x[6]]);
        let q_dot = Quaternion::from_array([v[3], v[4], v[5], v[6]]);
        // ω = 2 q̇ ⋆ q̄
        let omega = q_dot.product(q.conjugate()).v * 2.0;
        let arm = q.rotate(self.position);
        let place = Vector3::new(x[0], x[1], x[2]) + arm;
        let speed = Vector3::new(v[0], v[1], v[2]) + omega.cross(&arm);
        let whole = |p: Vector3<f64>, q: Quaternion<f64>| {
            let [s, i, j, k] = q.to_array();
            [p.x, p.y, p.z, s, i, j, k]
        };
        (whole(place, q.product(self.orientation)), whole(speed, q_dot.product(self.orientation)))
    }
}

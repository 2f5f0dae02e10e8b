//! Rotations over a step.

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

/// A rotation from a step's beginning to its end, as a unit quaternion in world axes. Its vector part, and
/// what it does to an arm, are found without taking differences of nearly equal numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Turn {
    /// Scalar part.
    pub c: f64,
    /// Vector part.
    pub v: Vector3<f64>,
}

impl Turn {
    pub const NONE: Self = Self { c: 1.0, v: Vector3::new(0.0, 0.0, 0.0) };

    /// With this vector part. Beyond half a turn there is none; the nearest, then.
    #[inline]
    pub fn of_vector(v: Vector3<f64>) -> Self {
        Self { c: (1.0 - v.norm_squared()).max(0.0).sqrt(), v }
    }

    /// `(1, u)/√(1 + |u|²)`: about `u`, by an angle whose half has the tangent `|u|`.
    #[inline]
    pub fn cayley(u: Vector3<f64>) -> Self {
        let c = 1.0 / (1.0 + u.norm_squared()).sqrt();
        Self { c, v: u * c }
    }

    /// Axis times angle.
    pub fn rotation_vector(&self) -> Vector3<f64> {
        let sine = self.v.norm();
        if sine < 1e-9 {
            return self.v * 2.0;
        }
        self.v * (2.0 * sine.atan2(self.c) / sine)
    }

    /// This one after `first`.
    #[inline]
    pub fn after(&self, first: &Self) -> Self {
        Self {
            c: self.c * first.c - self.v.dot(&first.v),
            v: first.v * self.c + self.v * first.c + self.v.cross(&first.v),
        }
    }

    /// `R r − r`.
    #[inline]
    pub fn displacement(&self, r: &Vector3<f64>) -> Vector3<f64> {
        let across = self.v.cross(r);
        (across * self.c + self.v.cross(&across)) * 2.0
    }

    /// `R r`.
    #[inline]
    pub fn rotate(&self, r: &Vector3<f64>) -> Vector3<f64> {
        r + self.displacement(r)
    }

    /// `q` turned by it, of unit norm.
    pub fn turned(&self, [s, x, y, z]: [f64; 4]) -> [f64; 4] {
        let all = self.after(&Self { c: s, v: Vector3::new(x, y, z) });
        let scale = 1.0 / (all.c * all.c + all.v.norm_squared()).sqrt();
        [all.c * scale, all.v.x * scale, all.v.y * scale, all.v.z * scale]
    }
}

/// `r̂`, with `r̂ x = r × x`.
#[inline]
pub(super) fn skew(r: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::new(0.0, -r.z, r.y, r.z, 0.0, -r.x, -r.y, r.x, 0.0)
}

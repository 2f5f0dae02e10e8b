//! Floors that are not level, or not at z = 0: the law of a level one, seen from the plane.
//!
//! # Notation
//! `R`: world from plane, its z the normal; `o`: the plane's point. A point at `p` is at `Rᵀ (p − o)` in the plane, the
//! force on it there is turned back by `R`, and its derivative is `R K Rᵀ`.

use super::{ContactPoint, Floor, StepForce, Switching};
use nalgebra::{Matrix3, Rotation3, Unit, Vector3};

/// A plane that bodies stand on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GroundPlane {
    /// `R`
    rotation: Matrix3<f64>,
    /// `o`, m.
    point: Vector3<f64>,
}

impl GroundPlane {
    /// Through a point (m), as steep as `slope` (rad), ascending towards `uphill` (rad from x to y).
    pub fn new(point: Vector3<f64>, slope: f64, uphill: f64) -> Self {
        // Turned about the level line, which is a right angle to the left of uphill.
        let level = Unit::new_unchecked(Vector3::new(-uphill.sin(), uphill.cos(), 0.0));
        let rotation = Rotation3::from_axis_angle(&level, -slope).into_inner();
        Self { rotation, point }
    }

    /// How far a point is above the plane, along its normal, m.
    pub fn height(&self, p: &Vector3<f64>) -> f64 {
        self.rotation.column(2).dot(&(p - self.point))
    }

    /// How far the plane is above z = 0 over a place, m.
    pub fn height_at(&self, x: f64, y: f64) -> f64 {
        let normal = self.rotation.column(2);
        self.point.z - (normal.x * (x - self.point.x) + normal.y * (y - self.point.y)) / normal.z
    }

    /// World from plane.
    pub fn rotation(&self) -> &Matrix3<f64> {
        &self.rotation
    }

    /// As [`ContactPoint::over_step`].
    pub fn over_step(
        &self,
        contact: &ContactPoint,
        (floor, switching): (&Floor, Switching),
        p0: Vector3<f64>,
        way: Vector3<f64>,
        h: f64,
    ) -> StepForce {
        let r = &self.rotation;
        let [p0, way] = [p0 - self.point, way].map(|v| r.tr_mul(&v));
        let StepForce { force, slope, point } = contact.over_step(floor, switching, p0, way, h);
        StepForce { force: r * force, slope: r * slope * r.transpose(), point }
    }

    /// As [`ContactPoint::spring_energy`].
    pub fn spring_energy(&self, contact: &ContactPoint, floor: &Floor, p: &Vector3<f64>) -> f64 {
        contact.spring_energy(floor, &self.rotation.tr_mul(&(p - self.point)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_ascends_uphill() {
        let plane = GroundPlane::new(Vector3::new(1.0, 2.0, 0.3), 0.1, 0.5);
        let ahead = 1e-3;
        let (x, y) = (1.0 + ahead * f64::cos(0.5), 2.0 + ahead * f64::sin(0.5));
        assert!((plane.height_at(x, y) - 0.3 - ahead * f64::tan(0.1)).abs() < 1e-15);
        assert!((plane.height_at(1.0 - f64::sin(0.5), 2.0 + f64::cos(0.5)) - 0.3).abs() < 1e-15);
        let above = Vector3::new(x, y, plane.height_at(x, y) + 0.2);
        assert!((plane.height(&above) - 0.2 * f64::cos(0.1)).abs() < 1e-15);
    }

    #[test]
    fn level_at_zero_it_is_the_floor() {
        let plane = GroundPlane::new(Vector3::zeros(), 0.0, 1.2);
        let (p, way) = (Vector3::new(0.3, -0.2, 1e-4), Vector3::new(1e-4, 2e-4, -3e-4));
        let law = (&Floor::RUBBER, Switching::WithinTheStep);
        let on_plane = plane.over_step(&ContactPoint::FREE, law, p, way, 1e-3);
        let level = ContactPoint::FREE.over_step(law.0, law.1, p, way, 1e-3);
        assert!((on_plane.force - level.force).norm() < 1e-12 * level.force.norm());
        assert!((on_plane.slope - level.slope).norm() < 1e-12 * level.slope.norm());
    }
}

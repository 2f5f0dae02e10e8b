//! A box that points strike. Its faces yield as the floor does, by the law of §5.2; a point meets one face at
//! a time.
//!
//! # Notation
//! All in the box's axes: `a` a point, `c` the box's centre, `b` half its edges.
//! ```text
//! d_i = |a_i − c_i| − b_i        height above the nearer of the two faces across axis i
//! d   = max d_i                  above the box where it is positive; else the least depth, and its face
//! ```
//! A free point that ends a step inside has come through the face whose plane it crossed last, on the
//! straight line between the step's ends: so the work against that face is what its springs hold. From then
//! on it stays with that face until it leaves it, or slides over its edge.

use super::{ContactPoint, ContactState, Floor, Switching};
use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

/// A box, and how its faces yield to each point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct YieldingBox {
    /// `c`, m.
    pub center: [f64; 3],
    /// `b`, m.
    pub half_size: [f64; 3],
    /// The law of §5.2, with a face as the floor.
    pub surface: Floor,
}

/// A face of a box.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Face {
    /// The axis across it: 0, 1, 2.
    pub axis: usize,
    /// On the side of the greater coordinate.
    pub is_upper: bool,
}

/// What a point that may strike a box remembers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BoxPoint {
    /// Its state; anchor and velocity are along the face.
    pub contact: ContactPoint,
    /// The face that it touches.
    pub face: Option<Face>,
}

/// A force on a point, in the box's axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoxForce {
    /// N
    pub force: Vector3<f64>,
    /// Its derivative with respect to where the point is in the box at a step's end, N/m.
    pub slope: Matrix3<f64>,
    /// The point's memory after it.
    pub point: BoxPoint,
}

const NOTHING: BoxForce = BoxForce {
    force: Vector3::new(0.0, 0.0, 0.0),
    slope: Matrix3::new(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    point: BoxPoint { contact: ContactPoint::FREE, face: None },
};

impl YieldingBox {
    /// `d`, and its face.
    pub fn height(&self, a: &Vector3<f64>) -> (f64, Face) {
        let mut highest = self.across(0, a);
        for axis in 1..3 {
            let found = self.across(axis, a);
            if found.0 > highest.0 {
                highest = found;
            }
        }
        highest
    }

    /// `d_i`, and the nearer face.
    fn across(&self, axis: usize, a: &Vector3<f64>) -> (f64, Face) {
        let from_center = a[axis] - self.center[axis];
        let face = Face { axis, is_upper: from_center >= 0.0 };
        (from_center.abs() - self.half_size[axis], face)
    }

    /// The face by which a point has come inside; none where it is outside at the end.
    fn entered(&self, a0: &Vector3<f64>, a1: &Vector3<f64>) -> Option<Face> {
        let (d, nearest) = self.height(a1);
        if d >= 0.0 {
            return None;
        }
        // When it crossed each plane, as a share of the step. One that was inside before has no such face.
        let mut last = (0.0, nearest);
        for axis in 0..3 {
            let ((before, face), (after, _)) = (self.across(axis, a0), self.across(axis, a1));
            let crossed = before / (before - after);
            if before > 0.0 && crossed > last.0 {
                last = (crossed, face);
            }
        }
        Some(last.1)
    }

    /// Radius of the sphere about its centre that holds it, m.
    pub fn radius(&self) -> f64 {
        Vector3::from(self.half_size).norm()
    }

    /// The face's axes: two along it, one outward.
    fn axes(face: Face) -> Matrix3<f64> {
        let [mut u, mut v, mut n] = [Vector3::zeros(); 3];
        u[(face.axis + 1) % 3] = 1.0;
        v[(face.axis + 2) % 3] = 1.0;
        n[face.axis] = if face.is_upper { 1.0 } else { -1.0 };
        Matrix3::from_columns(&[u, v, n])
    }

    /// The point beside and above a face.
    fn on(&self, face: Face, axes: &Matrix3<f64>, a: &Vector3<f64>) -> Vector3<f64> {
        let mut p = axes.tr_mul(&(a - Vector3::from(self.center)));
        p.z -= self.half_size[face.axis];
        p
    }

    /// Whether a point is beyond the edge of a face.
    fn is_beside(&self, face: Face, a: &Vector3<f64>) -> bool {
        (0..3).any(|i| i != face.axis && (a[i] - self.center[i]).abs() > self.half_size[i])
    }
}

impl BoxPoint {
    /// The face that it still touches, from where it is.
    fn kept_face(&self, of: &YieldingBox, a: &Vector3<f64>) -> Option<Face> {
        self.face.filter(|face| !of.is_beside(*face, a))
    }

    fn after(contact: ContactPoint, face: Face) -> Self {
        let is_free = contact.state == ContactState::Free;
        Self { contact, face: (!is_free).then_some(face) }
    }

    /// The mean force of a step from `a₀` to `a₁`.
    pub fn over_step(
        &self,
        of: &YieldingBox,
        switching: Switching,
        a0: &Vector3<f64>,
        a1: &Vector3<f64>,
        h: f64,
    ) -> BoxForce {
        let (contact, face) = match self.kept_face(of, a0) {
            Some(face) => (self.contact, face),
            None => match of.entered(a0, a1) {
                Some(face) => (ContactPoint::FREE, face),
                None => return NOTHING,
            },
        };
        let axes = YieldingBox::axes(face);
        let (p0, way) = (of.on(face, &axes, a0), axes.tr_mul(&(a1 - a0)));
        let step = contact.over_step(&of.surface, switching, p0, way, h);
        BoxForce {
            force: axes * step.force,
            slope: axes * step.slope * axes.transpose(),
            point: Self::after(step.point, face),
        }
    }

    /// The force at an instant, at `a`, moving at `velocity` in the box: for explicit methods.
    pub fn evaluate(
        &self,
        of: &YieldingBox,
        a: &Vector3<f64>,
        velocity: &Vector3<f64>,
    ) -> (Vector3<f64>, Self) {
        let (contact, face) = match self.kept_face(of, a) {
            Some(face) => (self.contact, face),
            None => {
                let (d, face) = of.height(a);
                if d >= 0.0 {
                    return (Vector3::zeros(), Self::default());
                }
                (ContactPoint::FREE, face)
            }
        };
        let axes = YieldingBox::axes(face);
        let p = of.on(face, &axes, a);
        let found = contact.evaluate(&of.surface, p, axes.tr_mul(velocity));
        (axes * found.force, Self::after(found.point, face))
    }

    /// Energy that the face's springs hold with the point at rest at `a`, J.
    pub fn spring_energy(&self, of: &YieldingBox, a: &Vector3<f64>) -> f64 {
        self.face.map_or(0.0, |face| {
            let p = of.on(face, &YieldingBox::axes(face), a);
            self.contact.spring_energy(&of.surface, &p)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOX: YieldingBox =
        YieldingBox { center: [0.1, 0.0, 0.0], half_size: [0.2, 0.3, 0.4], surface: Floor::RUBBER };
    const H: f64 = 1e-3;

    /// On each of the six faces a point feels what it would on the floor.
    #[test]
    fn a_face_is_a_floor() {
        for axis in 0..3 {
            for sign in [1.0, -1.0] {
                let mut outward = Vector3::zeros();
                outward[axis] = sign;
                let mut along = Vector3::zeros();
                along[(axis + 1) % 3] = 0.01;
                let surface = Vector3::from(BOX.center) + outward * BOX.half_size[axis] + along;
                let (a0, a1) = (surface + outward * 1e-3, surface - outward * 2e-3 + along * 0.1);
                let found =
                    BoxPoint::default().over_step(&BOX, Switching::WithinTheStep, &a0, &a1, H);
                let floor = ContactPoint::default().over_step(
                    &BOX.surface,
                    Switching::WithinTheStep,
                    Vector3::new(0.01, 0.0, 1e-3),
                    Vector3::new(1e-3, 0.0, -3e-3),
                    H,
                );
                assert!((found.force.dot(&outward) - floor.force.z).abs() < 1e-9);
                assert!((found.force.dot(&along) - 0.01 * floor.force.x).abs() < 1e-9);
                assert_eq!(found.point.face, Some(Face { axis, is_upper: sign > 0.0 }));
                let (at, _) = BoxPoint::default().evaluate(&BOX, &a1, &((a1 - a0) / H));
                assert!(at.dot(&outward) > 0.0);
            }
        }
    }

    #[test]
    fn slopes_are_derivatives() {
        let point = BoxPoint::default();
        for (a0, a1) in [
            ([0.301, 0.02, 0.1], [0.2985, 0.021, 0.1005]),
            // Around an edge: nearer to one face, but through the other.
            ([0.301, 0.3005, 0.1], [0.2985, 0.2992, 0.1]),
        ] {
            let (a0, a1) = (Vector3::from(a0), Vector3::from(a1));
            let at = |a: Vector3<f64>| point.over_step(&BOX, Switching::WithinTheStep, &a0, &a, H);
            let here = at(a1);
            assert!(here.force.norm() > 1.0);
            assert_eq!(here.point.face, Some(Face { axis: 0, is_upper: true }));
            for j in 0..3 {
                let mut d = Vector3::zeros();
                d[j] = 1e-9;
                let slope = (at(a1 + d).force - at(a1 - d).force) / 2e-9;
                assert!((slope - here.slope.column(j)).norm() < 1e-5 * here.slope.norm());
            }
        }
    }

    #[test]
    fn a_point_that_slides_over_the_edge_is_free() {
        let (a0, a1) = (Vector3::new(0.301, 0.2995, 0.0), Vector3::new(0.299, 0.2999, 0.0));
        let inside = BoxPoint::default().over_step(&BOX, Switching::WithinTheStep, &a0, &a1, H);
        let face = inside.point.face;
        assert!(face.is_some());
        let beyond = Vector3::new(0.299, 0.3002, 0.0);
        let held = inside.point.over_step(&BOX, Switching::WithinTheStep, &a1, &beyond, H);
        assert_eq!(held.point.face, face);
        let gone = held.point.over_step(&BOX, Switching::WithinTheStep, &beyond, &beyond, H);
        assert_eq!((gone.force, gone.point), (Vector3::zeros(), BoxPoint::default()));
    }
}

//! Solids where they are, and which of them hides which.

use super::Solid;
use nalgebra::Vector3;
use surefoot::spatial::Pose;

/// A solid where it is.
pub(super) struct Placed<'a> {
    pub(super) vertices: Vec<Vector3<f64>>,
    pub(super) faces: &'a [Vec<usize>],
}

impl<'a> Placed<'a> {
    pub(super) fn new(solid: &'a Solid, pose: &Pose<f64>) -> Self {
        let vertex = |v: &[f64; 3]| pose.transform_point((*v).into());
        Self { vertices: solid.vertices.iter().map(vertex).collect(), faces: &solid.faces }
    }

    pub(super) fn middle(&self) -> Vector3<f64> {
        self.vertices.iter().sum::<Vector3<f64>>() / self.vertices.len() as f64
    }

    pub(super) fn normal(&self, face: &[usize]) -> Vector3<f64> {
        let (a, b, c) = (self.vertices[face[0]], self.vertices[face[1]], self.vertices[face[2]]);
        (b - a).cross(&(c - b)).normalize()
    }

    /// How far the other solid reaches behind a face of this one at least, m, negative where it is wholly
    /// in front of none; and whether the eye is in front of that face.
    fn clearance(&self, other: &Self, eye: &Vector3<f64>) -> (f64, bool) {
        let of_face = |face: &Vec<usize>| {
            let normal = self.normal(face);
            let level = normal.dot(&self.vertices[face[0]]);
            let lowest = other.vertices.iter().map(|v| normal.dot(v)).fold(f64::INFINITY, f64::min);
            (lowest - level, normal.dot(eye) > level)
        };
        let best = self.faces.iter().map(of_face).max_by(|a, b| a.0.total_cmp(&b.0));
        best.unwrap_or((f64::NEG_INFINITY, true))
    }

    /// Whether this solid may hide the other and is painted later. The plane that tells is the face, of
    /// either, behind which the other lies least: at joints solids overlap, and no plane separates them
    /// wholly.
    fn may_hide(&self, other: &Self, eye: &Vector3<f64>) -> bool {
        let ((ours, eye_ours), (theirs, eye_theirs)) =
            (self.clearance(other, eye), other.clearance(self, eye));
        if ours > theirs { !eye_ours } else { eye_theirs }
    }
}

/// Order in which to paint, the hidden first: one after the other that may hide none of those left.
pub(super) fn back_to_front<C>(solids: &[(Placed<'_>, C)], eye: Vector3<f64>) -> Vec<usize> {
    let mut waiting: Vec<usize> = (0..solids.len()).collect();
    let far = |k: &usize| (solids[*k].0.middle() - eye).norm();
    waiting.sort_by(|a, b| far(b).total_cmp(&far(a)));
    let mut order = Vec::with_capacity(waiting.len());
    while !waiting.is_empty() {
        let hides_none = |a: &usize| {
            waiting.iter().all(|b| a == b || !solids[*a].0.may_hide(&solids[*b].0, &eye))
        };
        // In a circle of solids that hide each other the farthest is first.
        let next = waiting.iter().position(hides_none).unwrap_or(0);
        order.push(waiting.remove(next));
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_behind_is_painted_first() {
        let wall = Solid::cuboid([4.0, 0.1, 2.0]);
        let cube = Solid::cuboid([0.2, 0.2, 0.2]);
        let at = |x: f64, y: f64| Pose { position: Vector3::new(x, y, 0.0), ..Pose::identity() };
        let eye = Vector3::new(0.0, -5.0, 0.0);
        // The cube behind the wall's end is nearer to the eye than the wall's middle is to the cube's.
        for (y, expected) in [(0.3, [1, 0]), (-0.3, [0, 1])] {
            let solids =
                [(Placed::new(&wall, &at(1.0, 0.0)), ()), (Placed::new(&cube, &at(-0.5, y)), ())];
            assert_eq!(back_to_front(&solids, eye), expected, "a cube at {y} m");
        }
    }
}

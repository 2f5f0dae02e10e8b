//! Convex solids.

use nalgebra::{Matrix3, Rotation3, Vector3};
use serde::Serialize;

/// A convex polyhedron in the frame of its body.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Solid {
    /// Corners, m.
    pub vertices: Vec<[f64; 3]>,
    /// Corners of each face by index, anticlockwise when seen from outside.
    pub faces: Vec<Vec<usize>>,
}

impl Solid {
    /// A prism along y: a convex profile in the plane of x and z (m, anticlockwise when seen from −y), from
    /// `−half_width` to `half_width`.
    pub fn prism(profile: &[[f64; 2]], half_width: f64) -> Self {
        let n = profile.len();
        let at = |y: f64| profile.iter().map(move |[x, z]| [*x, y, *z]);
        let vertices = at(-half_width).chain(at(half_width)).collect();
        let sides = (0..n).map(|i| {
            let next = (i + 1) % n;
            vec![i, n + i, n + next, next]
        });
        let ends = [(0..n).collect(), (n..2 * n).rev().collect()];
        Self { vertices, faces: sides.chain(ends).collect() }
    }

    /// A box of these edges (m) around the origin.
    pub fn cuboid(edges: [f64; 3]) -> Self {
        let [x, y, z] = edges.map(|edge| edge / 2.0);
        Self::prism(&[[-x, -z], [x, -z], [x, z], [-x, z]], y)
    }

    /// The box of uniform density that has this mass (kg) and these principal moments of inertia (kg·m²):
    /// its edge along x is `√(6 (I_y + I_z − I_x)/m)`, and so on in turn. `None` where there is no such box.
    pub fn uniform_box(mass: f64, inertia: &Matrix3<f64>) -> Option<Self> {
        let total = inertia.trace();
        let edges = [0, 1, 2].map(|i| 6.0 * (total - 2.0 * inertia[(i, i)]) / mass);
        edges.iter().all(|edge| *edge > 0.0).then(|| Self::cuboid(edges.map(f64::sqrt)))
    }

    /// A square prism of this thickness (m) from one point to another.
    pub fn rod(from: Vector3<f64>, to: Vector3<f64>, thickness: f64) -> Self {
        let along = to - from;
        let rotation = Rotation3::rotation_between(&Vector3::z(), &along).unwrap_or_else(|| {
            Rotation3::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI)
        });
        Self::cuboid([thickness, thickness, along.norm()])
            .moved(rotation.matrix(), 0.5 * (from + to))
    }

    /// An icosahedron, as what has no shape of its own, of this radius (m) around the origin.
    pub fn ball(radius: f64) -> Self {
        let golden = 0.5 * (1.0 + 5.0_f64.sqrt());
        let unit = radius / f64::hypot(1.0, golden);
        let (a, b) = (unit, unit * golden);
        let vertices = vec![
            [-a, b, 0.0],
            [a, b, 0.0],
            [-a, -b, 0.0],
            [a, -b, 0.0],
            [0.0, -a, b],
            [0.0, a, b],
            [0.0, -a, -b],
            [0.0, a, -b],
            [b, 0.0, -a],
            [b, 0.0, a],
            [-b, 0.0, -a],
            [-b, 0.0, a],
        ];
        const FACES: [[usize; 3]; 20] = [
            [0, 11, 5],
            [0, 5, 1],
            [0, 1, 7],
            [0, 7, 10],
            [0, 10, 11],
            [1, 5, 9],
            [5, 11, 4],
            [11, 10, 2],
            [10, 7, 6],
            [7, 1, 8],
            [3, 9, 4],
            [3, 4, 2],
            [3, 2, 6],
            [3, 6, 8],
            [3, 8, 9],
            [4, 9, 5],
            [2, 4, 11],
            [6, 2, 10],
            [8, 6, 7],
            [9, 8, 1],
        ];
        Self { vertices, faces: FACES.map(|face| face.to_vec()).to_vec() }
    }

    /// The same in another size: its longest edge along an axis is `length`, m.
    pub fn scaled_to(self, length: f64) -> Self {
        let longest = self.extent().into_iter().fold(0.0, f64::max);
        let scale = if longest > 0.0 { length / longest } else { 1.0 };
        let vertices = self.vertices.into_iter().map(|v| v.map(|x| x * scale)).collect();
        Self { vertices, ..self }
    }

    /// The same, elsewhere: turned first, then moved.
    pub fn moved(self, rotation: &Matrix3<f64>, by: Vector3<f64>) -> Self {
        let point = |p: [f64; 3]| (rotation * Vector3::from(p) + by).into();
        Self { vertices: self.vertices.into_iter().map(point).collect(), ..self }
    }

    /// Edges of the box along the axes around it, m.
    pub fn extent(&self) -> [f64; 3] {
        [0, 1, 2].map(|i| {
            let along = self.vertices.iter().map(|vertex| vertex[i]);
            along.clone().fold(f64::NEG_INFINITY, f64::max) - along.fold(f64::INFINITY, f64::min)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each face's normal, by its corners' order, points away from the middle.
    pub(super) fn faces_outwards(solid: &Solid) -> bool {
        let vertex = |i: usize| Vector3::from(solid.vertices[i]);
        let middle = solid.vertices.iter().map(|v| Vector3::from(*v)).sum::<Vector3<f64>>()
            / solid.vertices.len() as f64;
        solid.faces.iter().all(|face| {
            let (a, b, c) = (vertex(face[0]), vertex(face[1]), vertex(face[2]));
            (b - a).cross(&(c - b)).dot(&(a - middle)) > 0.0
        })
    }

    #[test]
    fn faces_look_outwards() {
        assert!(faces_outwards(&Solid::cuboid([0.1, 0.2, 0.3])));
        assert!(faces_outwards(&Solid::prism(&[[0.0, 0.0], [2.0, 0.0], [0.0, 1.0]], 0.4)));
        assert!(faces_outwards(&Solid::ball(0.3)));
        assert!(faces_outwards(&Solid::rod(Vector3::x(), Vector3::new(0.2, -0.4, -1.0), 0.1)));
    }

    /// A box has the moments `m (b² + c²)/12`.
    #[test]
    fn a_uniform_box_has_the_inertia_that_it_is_made_from() {
        let inertia = Matrix3::from_diagonal(&Vector3::new(1.67, 1.58, 0.581));
        let [a, b, c] = Solid::uniform_box(45.0, &inertia).expect("a body").extent();
        for (ours, expected) in [
            (45.0 * (b * b + c * c) / 12.0, 1.67),
            (45.0 * (a * a + c * c) / 12.0, 1.58),
            (45.0 * (a * a + b * b) / 12.0, 0.581),
        ] {
            assert!((ours - expected).abs() < 1e-12, "{ours} against {expected}");
        }
        let no_body = Matrix3::from_diagonal(&Vector3::new(3.0, 1.0, 1.0));
        assert_eq!(Solid::uniform_box(1.0, &no_body), None);
    }
}

//! Joints as constraints between two bodies.
//!
//! # Notation
//! `o, i`: outboard and inboard body; `a_o, a_i`: the joint's point in their frames; `R v = q ⋆ v ⋆ q̄`,
//! for a quaternion of any length, as Newton's iterates have

use super::body::BodyState;
use super::constrained::tree_solver::{COORDINATES, MOST};
use surefoot_mechanics::Scalar;

/// Constraints that a joint may have.
pub const MOST_CONSTRAINTS: usize = MOST;

/// A joint: where it sits in both bodies, and what it keeps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joint {
    /// `a_o`: its point in the outboard body, m.
    pub outboard: [f64; 3],
    /// `a_i`: its point in the inboard body, m.
    pub inboard: [f64; 3],
    /// Outboard's orientation in the inboard body where the joint's angles are zero, scalar first.
    pub home: [f64; 4],
    /// What it keeps.
    pub constraint: JointConstraint,
}

/// What a joint keeps. Axes are unit vectors; each is given in the frame of the body that it names.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum JointConstraint {
    /// Nothing.
    Floating,
    /// The points together: 3.
    Spherical,
    /// The points together, and the two axes at a right angle: 4.
    Universal {
        /// In the outboard body.
        outboard_axis: [f64; 3],
        /// In the inboard body.
        inboard_axis: [f64; 3],
    },
    /// The points together, and an axis common to both: 5.
    Revolute {
        /// In the outboard body.
        axis: [f64; 3],
    },
    /// The orientation, and the points on an axis: 5.
    Prismatic {
        /// In the inboard body.
        axis: [f64; 3],
    },
    /// The points together, and the orientation: 6.
    Fixed,
}

impl Joint {
    /// What holds a body where it is.
    pub fn weld(&[x, y, z, s, i, j, k]: &BodyState) -> Self {
        Self {
            outboard: [0.0; 3],
            inboard: [x, y, z],
            home: [s, i, j, k],
            constraint: JointConstraint::Fixed,
        }
    }

    /// How many constraints it has.
    pub fn constraints(&self) -> usize {
        match self.constraint {
            JointConstraint::Floating => 0,
            JointConstraint::Spherical => 3,
            JointConstraint::Universal { .. } => 4,
            JointConstraint::Revolute { .. } | JointConstraint::Prismatic { .. } => 5,
            JointConstraint::Fixed => 6,
        }
    }

    /// `g_k(X_o, X_i)`; entries beyond its constraints are zero.
    pub fn evaluate<D: Scalar>(&self, outboard: &[D; 7], inboard: &[D; 7]) -> [D; MOST] {
        let (q_o, q_i) = (quaternion(outboard), quaternion(inboard));
        let at_o = rotated(&q_o, &self.outboard);
        let at_i = rotated(&q_i, &self.inboard);
        let apart: [D; 3] = std::array::from_fn(|k| outboard[k] + at_o[k] - inboard[k] - at_i[k]);
        let zero = D::from(0.0);
        let [x, y, z] = apart;
        match &self.constraint {
            JointConstraint::Floating => [zero; MOST],
            JointConstraint::Spherical => [x, y, z, zero, zero, zero],
            JointConstraint::Universal { outboard_axis, inboard_axis } => {
                let square = dot(&rotated(&q_i, inboard_axis), &rotated(&q_o, outboard_axis));
                [x, y, z, square, zero, zero]
            }
            JointConstraint::Revolute { axis } => {
                let [u, w] = across(&rotated(&self.home, axis));
                let axis = rotated(&q_o, axis);
                let square = [u, w].map(|v| dot(&rotated(&q_i, &v), &axis));
                [x, y, z, square[0], square[1], zero]
            }
            JointConstraint::Prismatic { axis } => {
                let off = across(axis).map(|v| dot(&rotated(&q_i, &v), &apart));
                let [a, b, c] = turned_away(&q_o, &q_i, &self.home);
                [off[0], off[1], a, b, c, zero]
            }
            JointConstraint::Fixed => {
                let [a, b, c] = turned_away(&q_o, &q_i, &self.home);
                [x, y, z, a, b, c]
            }
        }
    }

    /// `g_k`, `G_o` and `G_i`, written out: by differentiation they took nine tenths of a step.
    pub fn rows(&self, outboard: &[f64; 7], inboard: &[f64; 7]) -> Rows {
        let nothing = [[0.0; COORDINATES]; MOST];
        let mut rows =
            Rows { error: self.evaluate(outboard, inboard), outboard: nothing, inboard: nothing };
        let (q_o, q_i) = (quaternion(outboard), quaternion(inboard));
        let points = [rotation_slope(&q_o, &self.outboard), rotation_slope(&q_i, &self.inboard)];
        match &self.constraint {
            JointConstraint::Floating => {}
            JointConstraint::Spherical => rows.together(&points),
            JointConstraint::Universal { outboard_axis, inboard_axis } => {
                rows.together(&points);
                rows.square(3, (&q_o, outboard_axis), (&q_i, inboard_axis));
            }
            JointConstraint::Revolute { axis } => {
                rows.together(&points);
                for (k, across) in across(&rotated(&self.home, axis)).iter().enumerate() {
                    rows.square(3 + k, (&q_o, axis), (&q_i, across));
                }
            }
            JointConstraint::Prismatic { axis } => {
                let (at_o, at_i) = (rotated(&q_o, &self.outboard), rotated(&q_i, &self.inboard));
                let apart: [f64; 3] =
                    std::array::from_fn(|k| outboard[k] + at_o[k] - inboard[k] - at_i[k]);
                for (k, across) in across(axis).iter().enumerate() {
                    let direction = rotated(&q_i, across);
                    let slope = rotation_slope(&q_i, across);
                    for i in 0..3 {
                        rows.outboard[k][i] = direction[i];
                        rows.inboard[k][i] = -direction[i];
                        for j in 0..4 {
                            rows.outboard[k][3 + j] += direction[i] * points[0][i][j];
                            rows.inboard[k][3 + j] +=
                                apart[i] * slope[i][j] - direction[i] * points[1][i][j];
                        }
                    }
                }
                rows.oriented(2, (&q_o, &q_i), &self.home);
            }
            JointConstraint::Fixed => {
                rows.together(&points);
                rows.oriented(3, (&q_o, &q_i), &self.home);
            }
        }
        rows
    }
}

/// A joint's constraints and their derivatives; rows beyond its constraints are zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rows {
    /// `g`
    pub error: [f64; MOST],
    /// `G_o`
    pub outboard: [[f64; COORDINATES]; MOST],
    /// `G_i`
    pub inboard: [[f64; COORDINATES]; MOST],
}

impl Rows {
    /// First three rows: the points together.
    fn together(&mut self, [outboard, inboard]: &[[[f64; 4]; 3]; 2]) {
        for i in 0..3 {
            self.outboard[i][i] = 1.0;
            self.inboard[i][i] = -1.0;
            for j in 0..4 {
                self.outboard[i][3 + j] = outboard[i][j];
                self.inboard[i][3 + j] = -inboard[i][j];
            }
        }
    }

    /// One row: two axes at a right angle.
    fn square(
        &mut self,
        row: usize,
        (q_o, axis): (&[f64; 4], &[f64; 3]),
        (q_i, across): (&[f64; 4], &[f64; 3]),
    ) {
        let (a, b) = (rotated(q_o, axis), rotated(q_i, across));
        let (of_a, of_b) = (rotation_slope(q_o, axis), rotation_slope(q_i, across));
        for i in 0..3 {
            for j in 0..4 {
                self.outboard[row][3 + j] += b[i] * of_a[i][j];
                self.inboard[row][3 + j] += a[i] * of_b[i][j];
            }
        }
    }

    /// Three rows: the orientation.
    fn oriented(&mut self, first: usize, (q_o, q_i): (&[f64; 4], &[f64; 4]), r: &[f64; 4]) {
        for j in 0..4 {
            let mut unit = [0.0; 4];
            unit[j] = 1.0;
            // It is linear in each quaternion.
            let (by_o, by_i) = (turned_away(&unit, q_i, r), turned_away(q_o, &unit, r));
            for i in 0..3 {
                self.outboard[first + i][3 + j] = by_o[i];
                self.inboard[first + i][3 + j] = by_i[i];
            }
        }
    }
}

/// Two unit vectors at right angles to an axis and to each other.
pub(super) fn across([x, y, z]: &[f64; 3]) -> [[f64; 3]; 2] {
    // Duff et al. 2017, "Building an orthonormal basis, revisited".
    let sign = 1.0_f64.copysign(*z);
    let a = -1.0 / (sign + z);
    let b = x * y * a;
    [[1.0 + sign * x * x * a, sign * b, -sign * x], [b, sign + y * y * a, -y]]
}

/// Derivative of [`rotated`] with respect to the quaternion.
fn rotation_slope([s, a, b, c]: &[f64; 4], v: &[f64; 3]) -> [[f64; 4]; 3] {
    let u = [*a, *b, *c];
    let along = u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let mut row = [0.0; 4];
        row[0] = s * v[i] + u[j] * v[k] - u[k] * v[j];
        for n in 0..3 {
            row[1 + n] = u[i] * v[n] - u[n] * v[i];
        }
        row[1 + i] += along;
        // s e_n × v
        row[1 + j] += s * v[k];
        row[1 + k] -= s * v[j];
        row.map(|x| 2.0 * x)
    })
}

fn quaternion<D: Scalar>(x: &[D; 7]) -> [D; 4] {
    [x[3], x[4], x[5], x[6]]
}

/// `vec(q ⋆ (0, v) ⋆ q̄) = (s² − |u|²) v + 2 (u·v) u + 2 s u × v`
pub(super) fn rotated<D: Scalar>([s, a, b, c]: &[D; 4], v: &[f64; 3]) -> [D; 3] {
    let (s, u) = (*s, [*a, *b, *c]);
    let along = (u[0] * v[0] + u[1] * v[1] + u[2] * v[2]) * 2.0;
    let scale = s * s - u[0] * u[0] - u[1] * u[1] - u[2] * u[2];
    let cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    std::array::from_fn(|i| scale * v[i] + u[i] * along + cross[i] * s * 2.0)
}

/// `vec(conj(q_i ⋆ r) ⋆ q_o)`: half the rotation vector between the orientations, for small ones.
fn turned_away<D: Scalar>(q_o: &[D; 4], q_i: &[D; 4], r: &[f64; 4]) -> [D; 3] {
    let wanted = product(q_i, &r.map(D::from));
    let [s, a, b, c] = wanted;
    let [_, x, y, z] = product(&[s, -a, -b, -c], q_o);
    [x, y, z]
}

pub(super) fn product<D: Scalar>(a: &[D; 4], b: &[D; 4]) -> [D; 4] {
    [
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] + a[2] * b[0] + a[3] * b[1] - a[1] * b[3],
        a[0] * b[3] + a[3] * b[0] + a[1] * b[2] - a[2] * b[1],
    ]
}

fn dot<D: Scalar>(a: &[D; 3], b: &[D; 3]) -> D {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

//! Joints as constraints between two bodies.
//!
//! # Notation
//! `o, i`: outboard and inboard body; `a_o, a_i`: the joint's point in their frames; `R v = q ⋆ v ⋆ q̄`,
//! for a quaternion of any length, as Newton's iterates have

use super::tree_solver::{COORDINATES, MOST};
use crate::mechanics::{Scalar, jacobian};
use num_dual::Dual64;

/// Constraints that a joint may have.
pub const MOST_CONSTRAINTS: usize = MOST;

/// A joint: where it sits in both bodies, and what it keeps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joint {
    /// `a_o`: its point in the outboard body, m.
    pub outboard: [f64; 3],
    /// `a_i`: its point in the inboard body, m.
    pub inboard: [f64; 3],
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
        /// Two directions at right angles to it, in the inboard body.
        across: [[f64; 3]; 2],
    },
    /// The orientation, and the points on an axis: 5.
    Prismatic {
        /// Two directions at right angles to the axis, in the inboard body.
        across: [[f64; 3]; 2],
        /// Outboard's orientation in the inboard body, scalar first.
        orientation: [f64; 4],
    },
    /// The points together, and the orientation: 6.
    Fixed {
        /// Outboard's orientation in the inboard body, scalar first.
        orientation: [f64; 4],
    },
}

impl Joint {
    /// How many constraints it has.
    pub fn constraints(&self) -> usize {
        match self.constraint {
            JointConstraint::Floating => 0,
            JointConstraint::Spherical => 3,
            JointConstraint::Universal { .. } => 4,
            JointConstraint::Revolute { .. } | JointConstraint::Prismatic { .. } => 5,
            JointConstraint::Fixed { .. } => 6,
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
            JointConstraint::Revolute { axis, across: [u, w] } => {
                let axis = rotated(&q_o, axis);
                let square = [u, w].map(|v| dot(&rotated(&q_i, v), &axis));
                [x, y, z, square[0], square[1], zero]
            }
            JointConstraint::Prismatic { across: [u, w], orientation } => {
                let off = [u, w].map(|v| dot(&rotated(&q_i, v), &apart));
                let [a, b, c] = turned_away(&q_o, &q_i, orientation);
                [off[0], off[1], a, b, c, zero]
            }
            JointConstraint::Fixed { orientation } => {
                let [a, b, c] = turned_away(&q_o, &q_i, orientation);
                [x, y, z, a, b, c]
            }
        }
    }

    /// `g_k`, `G_o` and `G_i`, exactly.
    ///
    /// # Cost
    /// 14 evaluations in dual numbers; none for a floating joint.
    pub(super) fn rows(&self, outboard: &[f64; 7], inboard: &[f64; 7]) -> Rows {
        if self.constraints() == 0 {
            let nothing = [[0.0; COORDINATES]; MOST];
            return Rows { error: [0.0; MOST], outboard: nothing, inboard: nothing };
        }
        let still = [outboard, inboard].map(|x| x.map(Dual64::from_re));
        let (error, outboard) = jacobian(outboard, |x| self.evaluate(x, &still[1]));
        let (_, inboard) = jacobian(inboard, |x| self.evaluate(&still[0], x));
        Rows { error, outboard, inboard }
    }
}

/// A joint's constraints and their derivatives.
pub(super) struct Rows {
    pub error: [f64; MOST],
    pub outboard: [[f64; COORDINATES]; MOST],
    pub inboard: [[f64; COORDINATES]; MOST],
}

fn quaternion<D: Scalar>(x: &[D; 7]) -> [D; 4] {
    [x[3], x[4], x[5], x[6]]
}

/// `vec(q ⋆ (0, v) ⋆ q̄) = (s² − |u|²) v + 2 (u·v) u + 2 s u × v`
fn rotated<D: Scalar>([s, a, b, c]: &[D; 4], v: &[f64; 3]) -> [D; 3] {
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

fn product<D: Scalar>(a: &[D; 4], b: &[D; 4]) -> [D; 4] {
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

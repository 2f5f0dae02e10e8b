//! Derivatives of closing constraints along place and turn of both bodies, about their reference points.
//!
//! # Notation
//! `r` from a body's reference point to the joint's point, `u, w` axes of the outboard and the inboard body, all in
//! world axes; `δ` a motion of a reference point, `ω` a turn.
//! ```text
//! points together:  ∂/∂(δ, ω) of  e · (p_o − p_i)  =  ±(e, r × e)                                   (1)
//! axes square:      ∂/∂ω      of  u · w            =  ±u × w                                        (2)
//! ```
//! Other constraints are differentiated in seven coordinates, and brought here by `q̇ = ½ (0, ω) ⋆ q`.

use super::super::closure::{Closing, Closure};
use super::super::joint::{Joint, JointConstraint, across, rotated};
use super::super::{BodyState, Rows};
use super::stiffness::Pair;
use nalgebra::Vector3;

/// Constraints of one closure at most.
const MOST: usize = 6;

/// A body as a closure has it: its state, and the arm from its reference point to its centre of mass.
pub(super) type Seen = (BodyState, Vector3<f64>);

/// A constraint's error, and its derivative with respect to the outboard and the inboard body.
#[derive(Clone, Copy, Debug)]
pub(super) struct ClosingRow {
    pub error: f64,
    pub pairs: [Pair; 2],
}

impl ClosingRow {
    const NONE: Self = Self { error: 0.0, pairs: [Pair::ZERO; 2] };
}

/// All rows of a closure; those beyond its constraints are zero.
pub(super) fn closing_rows(
    closure: &Closure,
    outboard: &Seen,
    inboard: &Seen,
) -> [ClosingRow; MOST] {
    let mut rows = [ClosingRow::NONE; MOST];
    match &closure.closing {
        Closing::Joint(joint) => match joint.constraint {
            JointConstraint::Spherical => together(joint, outboard, inboard, &mut rows),
            JointConstraint::Universal { outboard_axis, inboard_axis } => {
                together(joint, outboard, inboard, &mut rows);
                rows[3] = square((outboard, &outboard_axis), (inboard, &inboard_axis));
            }
            JointConstraint::Revolute { axis } => {
                together(joint, outboard, inboard, &mut rows);
                for (row, across) in rows[3..].iter_mut().zip(across(&rotated(&joint.home, &axis)))
                {
                    *row = square((outboard, &axis), (inboard, &across));
                }
            }
            _ => general(closure, outboard, inboard, &mut rows),
        },
        Closing::General(_) => general(closure, outboard, inboard, &mut rows),
    }
    rows
}

/// (1) for the world's three axes.
fn together(joint: &Joint, (x_o, to_o): &Seen, (x_i, to_i): &Seen, rows: &mut [ClosingRow; MOST]) {
    let point = |x: &BodyState, arm: &[f64; 3]| Vector3::from(rotated(&orientation(x), arm));
    let (at_o, at_i) = (point(x_o, &joint.outboard), point(x_i, &joint.inboard));
    let arms = [to_o + at_o, to_i + at_i];
    for i in 0..3 {
        let mut unit = Vector3::zeros();
        unit[i] = 1.0;
        rows[i] = ClosingRow {
            error: x_o[i] + at_o[i] - x_i[i] - at_i[i],
            pairs: [
                Pair { linear: unit, angular: arms[0].cross(&unit) },
                Pair { linear: -unit, angular: -arms[1].cross(&unit) },
            ],
        };
    }
}

/// (2)
fn square(
    ((x_o, _), axis): (&Seen, &[f64; 3]),
    ((x_i, _), across): (&Seen, &[f64; 3]),
) -> ClosingRow {
    let u = Vector3::from(rotated(&orientation(x_o), axis));
    let w = Vector3::from(rotated(&orientation(x_i), across));
    let angular = u.cross(&w);
    let linear = Vector3::zeros();
    let pairs = [Pair { linear, angular }, Pair { linear, angular: -angular }];
    ClosingRow { error: u.dot(&w), pairs }
}

fn general(
    closure: &Closure,
    (x_o, to_o): &Seen,
    (x_i, to_i): &Seen,
    rows: &mut [ClosingRow; MOST],
) {
    let Rows { error, outboard, inboard } = closure.rows(x_o, x_i);
    for (c, row) in rows.iter_mut().enumerate().take(closure.constraints()) {
        let pairs = [tangent(&outboard[c], x_o, to_o), tangent(&inboard[c], x_i, to_i)];
        *row = ClosingRow { error: error[c], pairs };
    }
}

fn orientation(x: &BodyState) -> [f64; 4] {
    [x[3], x[4], x[5], x[6]]
}

/// A row in seven coordinates as one along place and turn (world axes) about a reference point, from which
/// `arm` leads to the centre of mass: `q̇ = ½ (0, ω) ⋆ q`.
fn tangent(row: &BodyState, x: &BodyState, arm: &Vector3<f64>) -> Pair {
    let linear = Vector3::new(row[0], row[1], row[2]);
    let [s, a, b, c] = [x[3], x[4], x[5], x[6]];
    let [g, i, j, k] = [row[3], row[4], row[5], row[6]];
    let turning = Vector3::new(
        -a * g + s * i - c * j + b * k,
        -b * g + c * i + s * j - a * k,
        -c * g - b * i + a * j + s * k,
    ) * 0.5;
    Pair { linear, angular: turning + arm.cross(&linear) }
}

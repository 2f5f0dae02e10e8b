//! The inverse of a leg's Jacobian, damped where it is singular.
//!
//! # Notation
//! `J`: c directions of the contact by n ≥ c joints, rows of moments and forces both without dimension
//! (lengths in units of the leg's reach); missing directions have zero rows.
//! ```text
//! J⁺ = Jᵀ (J Jᵀ + ε² 1)⁻¹ = (Jᵀ J + ε² 1)⁻¹ Jᵀ                                  (1)
//! ε² = ε₀² (1 − d/4ε₀²)²  for d < 4ε₀², else 0                                    (2)
//! ```
//! with `d = 1/‖J⁺‖²` of the exact inverse (Frobenius' norm): between a sixth of the square of the least
//! singular value and that square. So an inverse is exact until the leg is near a singular posture, grows
//! to no more than about `1/2ε₀`, and does not jump in between (Nakamura and Hanafusa, *ASME J. Dyn. Syst.* 108, 1986). An exact one is
//! refined once, `J⁺ ← J⁺ (2 − J J⁺)`, as (1) squares the condition.

use super::robot::MOST_LEG_JOINTS;
use crate::Real;
use crate::qp::Ldl;

/// Directions of a contact.
pub(super) const DIRECTIONS: usize = 6;

/// By joint.
pub(super) type ByJoint<T> = [[T; DIRECTIONS]; MOST_LEG_JOINTS];

/// `J⁺` by joint, and what of its directions is lost.
#[derive(Clone, Copy, Debug)]
pub(super) struct LegInverse<T> {
    pub inverse: ByJoint<T>,
    /// `ε²`
    pub damping: T,
}

/// (1) for the first `count` columns of `J`; the rows of others are zero. `None` for numbers that are not
/// finite.
#[inline(always)]
pub(super) fn leg_inverse<T: Real>(
    columns: &ByJoint<T>,
    count: usize,
    directions: &[bool; DIRECTIONS],
    least: T,
) -> Option<LegInverse<T>> {
    let columns = columns.get(..count)?;
    let (zero, one) = (T::zero(), T::one());
    let mut square = [[zero; DIRECTIONS]; DIRECTIONS];
    // Its lower triangle, which is all that is read.
    for column in columns {
        for (i, (row, x)) in square.iter_mut().zip(column).enumerate() {
            for (entry, y) in row.iter_mut().zip(column).take(i + 1) {
                *entry += *x * *y;
            }
        }
    }
    // A direction that does not exist is one by itself.
    for (i, exists) in directions.iter().enumerate() {
        if !exists {
            square[i][i] = one;
        }
    }
    let from = least * least * T::of(4.0);
    let mut d = zero;
    if let Some(factors) = Ldl::new(&square) {
        let mut inverse = solved(&factors, columns);
        let squares = inverse.as_flattened().iter().fold(zero, |sum, x| sum + *x * *x);
        // Where J is singular to the last bit, its inverse does not show it, but a pivot does.
        if squares > zero && squares.is_finite() {
            d = (one / squares).min(factors.least_pivot());
        }
        if d >= from {
            refine(&mut inverse, columns);
            return Some(LegInverse { inverse, damping: zero });
        }
    }
    damped(columns, square, directions, from, d)
}

/// (1) with (2) for `square`, `J Jᵀ`, and `d`.
#[cold]
#[inline(never)]
fn damped<T: Real>(
    columns: &[[T; DIRECTIONS]],
    mut square: [[T; DIRECTIONS]; DIRECTIONS],
    directions: &[bool; DIRECTIONS],
    from: T,
    d: T,
) -> Option<LegInverse<T>> {
    let share = T::one() - d / from;
    let damping = from * T::of(0.25) * share * share;
    for (i, exists) in directions.iter().enumerate() {
        if *exists {
            square[i][i] += damping;
        }
    }
    let factors = Ldl::new(&square)?;
    Some(LegInverse { inverse: solved(&factors, columns), damping })
}

/// `(J Jᵀ)⁻¹ J`, by joint.
#[inline(always)]
fn solved<T: Real>(factors: &Ldl<T, DIRECTIONS>, columns: &[[T; DIRECTIONS]]) -> ByJoint<T> {
    let mut inverse = [[T::zero(); DIRECTIONS]; MOST_LEG_JOINTS];
    for (row, column) in inverse.iter_mut().zip(columns) {
        *row = factors.solve(column);
    }
    inverse
}

/// `J⁺ ← J⁺ + J⁺ (1 − J J⁺)`
#[inline(always)]
fn refine<T: Real>(inverse: &mut ByJoint<T>, columns: &[[T; DIRECTIONS]]) {
    let mut left = [[T::zero(); DIRECTIONS]; DIRECTIONS];
    for (i, row) in left.iter_mut().enumerate() {
        row[i] = T::one();
    }
    for (column, inverse) in columns.iter().zip(inverse.iter()) {
        for (row, x) in left.iter_mut().zip(column) {
            for (entry, y) in row.iter_mut().zip(inverse) {
                *entry -= *x * *y;
            }
        }
    }
    for row in inverse.iter_mut().take(columns.len()) {
        let mut more = [T::zero(); DIRECTIONS];
        for (x, left) in row.iter().zip(&left) {
            for (more, left) in more.iter_mut().zip(left) {
                *more += *x * *left;
            }
        }
        for (x, more) in row.iter_mut().zip(more) {
            *x += more;
        }
    }
}

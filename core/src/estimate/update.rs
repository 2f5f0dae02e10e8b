//! One measurement into errors and covariance.
//!
//! # Notation
//! `Q = P Hᵀ`, `S = H Q + noise`, `e = y − H δ`:
//! ```text
//! K = Q S⁻¹    δ ← δ + K e    P ← P − K Qᵀ                                                  (10)
//! ```
//! The errors `δ` are kept through all measurements of a tick, each with the rows `H` of the tick's prediction,
//! and go into the state at its end (Solà 2017, sec. 6.1 and 6.2). `P − K Qᵀ` stays symmetric by
//! construction, and positive in f32 (Joseph's form would cost twice as much and is not needed: the least
//! eigenvalue agrees with f64's to 5e-5).

use super::covariance::{BODY, Covariance, PerError, Present};
use crate::Real;
use crate::spatial::SymmetricMatrix3;
use nalgebra::{Matrix3, Vector3};

/// (10) for three rows. `false`, and nothing changed, where `S` is not positive.
#[inline(always)]
pub(super) fn three_rows<T: Real, const FEET: usize>(
    p: &mut Covariance<T, FEET>,
    errors: &mut PerError<Vector3<T>, FEET>,
    present: &Present<FEET>,
    q: &PerError<Matrix3<T>, FEET>,
    (s, e): (&Matrix3<T>, Vector3<T>),
) -> bool {
    let Some(inverse) = SymmetricMatrix3::from_matrix(s).inverse() else { return false };
    let inverse = inverse.to_matrix();
    for j in 0..BODY {
        let gain = q.body[j] * inverse;
        errors.body[j] += gain * e;
        for k in 0..j {
            subtract(&mut p.body[j][k], &gain, &q.body[k]);
        }
        subtract_symmetric(&mut p.body[j][j], &gain, &q.body[j]);
    }
    let feet = p.feet.iter_mut().zip(&mut errors.feet).zip(present).zip(&q.feet).enumerate();
    for (number, (((rows, error), is_present), own)) in feet {
        for part in 0..2 {
            if !is_present[part] {
                continue;
            }
            let gain = own[part] * inverse;
            error[part] += gain * e;
            for k in 0..BODY {
                subtract(&mut rows.body[part][k], &gain, &q.body[k]);
            }
            let others = rows.feet.iter_mut().zip(&q.feet).zip(present).take(number + 1);
            for (other, ((pair, from), is_present)) in others.enumerate() {
                let row = &mut pair[part];
                for k in 0..2 {
                    if other == number && k == part {
                        subtract_symmetric(&mut row[k], &gain, &from[k]);
                    } else if is_present[k] && (other < number || k < part) {
                        subtract(&mut row[k], &gain, &from[k]);
                    }
                }
            }
        }
    }
    true
}

/// (10) for one row. `false`, and nothing changed, where `S` is not positive.
#[inline(always)]
pub(super) fn one_row<T: Real, const FEET: usize>(
    p: &mut Covariance<T, FEET>,
    errors: &mut PerError<Vector3<T>, FEET>,
    present: &Present<FEET>,
    q: &PerError<Vector3<T>, FEET>,
    (s, e): (T, T),
) -> bool {
    if !(s > T::zero()) {
        return false;
    }
    let inverse = T::one() / s;
    for j in 0..BODY {
        let gain = q.body[j] * inverse;
        errors.body[j] += gain * e;
        for k in 0..j {
            subtract_outer(&mut p.body[j][k], &gain, &q.body[k]);
        }
        subtract_outer_symmetric(&mut p.body[j][j], &gain, &q.body[j]);
    }
    let feet = p.feet.iter_mut().zip(&mut errors.feet).zip(present).zip(&q.feet).enumerate();
    for (number, (((rows, error), is_present), own)) in feet {
        for part in 0..2 {
            if !is_present[part] {
                continue;
            }
            let gain = own[part] * inverse;
            error[part] += gain * e;
            for k in 0..BODY {
                subtract_outer(&mut rows.body[part][k], &gain, &q.body[k]);
            }
            let others = rows.feet.iter_mut().zip(&q.feet).zip(present).take(number + 1);
            for (other, ((pair, from), is_present)) in others.enumerate() {
                let row = &mut pair[part];
                for k in 0..2 {
                    if other == number && k == part {
                        subtract_outer_symmetric(&mut row[k], &gain, &from[k]);
                    } else if is_present[k] && (other < number || k < part) {
                        subtract_outer(&mut row[k], &gain, &from[k]);
                    }
                }
            }
        }
    }
    true
}

/// Makes the upper triangle that of the lower.
#[inline(always)]
pub(super) fn mirror<T: Real>(m: &mut Matrix3<T>) {
    m.m12 = m.m21;
    m.m13 = m.m31;
    m.m23 = m.m32;
}

/// `M − K Qᵀ`.
#[inline(always)]
fn subtract<T: Real>(m: &mut Matrix3<T>, gain: &Matrix3<T>, q: &Matrix3<T>) {
    for c in 0..3 {
        for r in 0..3 {
            m[(r, c)] -=
                gain[(r, 0)] * q[(c, 0)] + gain[(r, 1)] * q[(c, 1)] + gain[(r, 2)] * q[(c, 2)];
        }
    }
}

/// The same where it is symmetric: six entries.
#[inline(always)]
fn subtract_symmetric<T: Real>(m: &mut Matrix3<T>, gain: &Matrix3<T>, q: &Matrix3<T>) {
    for c in 0..3 {
        for r in c..3 {
            m[(r, c)] -=
                gain[(r, 0)] * q[(c, 0)] + gain[(r, 1)] * q[(c, 1)] + gain[(r, 2)] * q[(c, 2)];
        }
    }
    mirror(m);
}

/// `M − k qᵀ`.
#[inline(always)]
fn subtract_outer<T: Real>(m: &mut Matrix3<T>, gain: &Vector3<T>, q: &Vector3<T>) {
    for c in 0..3 {
        for r in 0..3 {
            m[(r, c)] -= gain[r] * q[c];
        }
    }
}

/// The same where it is symmetric.
#[inline(always)]
fn subtract_outer_symmetric<T: Real>(m: &mut Matrix3<T>, gain: &Vector3<T>, q: &Vector3<T>) {
    for c in 0..3 {
        for r in c..3 {
            m[(r, c)] -= gain[r] * q[c];
        }
    }
    mirror(m);
}

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
use nalgebra::{Matrix3, SMatrix, SVector, Vector3};

/// (10) for `C` rows, with `S⁻¹` and `e`.
#[inline(always)]
pub(super) fn rows<T: Real, const C: usize, const FEET: usize>(
    p: &mut Covariance<T, FEET>,
    errors: &mut PerError<Vector3<T>, FEET>,
    present: &Present<FEET>,
    q: &PerError<SMatrix<T, 3, C>, FEET>,
    (inverse, e): (&SMatrix<T, C, C>, SVector<T, C>),
) {
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
fn subtract<T: Real, const C: usize>(
    m: &mut Matrix3<T>,
    gain: &SMatrix<T, 3, C>,
    q: &SMatrix<T, 3, C>,
) {
    for c in 0..3 {
        for r in 0..3 {
            m[(r, c)] -= product(gain, q, (r, c));
        }
    }
}

/// The same where it is symmetric: six entries.
#[inline(always)]
fn subtract_symmetric<T: Real, const C: usize>(
    m: &mut Matrix3<T>,
    gain: &SMatrix<T, 3, C>,
    q: &SMatrix<T, 3, C>,
) {
    for c in 0..3 {
        for r in c..3 {
            m[(r, c)] -= product(gain, q, (r, c));
        }
    }
    mirror(m);
}

/// An entry of `K Qᵀ`.
#[inline(always)]
fn product<T: Real, const C: usize>(
    gain: &SMatrix<T, 3, C>,
    q: &SMatrix<T, 3, C>,
    (r, c): (usize, usize),
) -> T {
    let mut sum = gain[(r, 0)] * q[(c, 0)];
    for k in 1..C {
        sum += gain[(r, k)] * q[(c, k)];
    }
    sum
}

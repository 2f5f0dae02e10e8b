//! What residuals are differences of, and so what their round-off is relative to.

use crate::mechanics::Scalar;

/// Largest absolute value, above zero.
pub(super) fn largest<D: Scalar>(values: &[D]) -> f64 {
    values.iter().fold(f64::MIN_POSITIVE, |m, x| m.max(x.re().abs()))
}

/// Size of the terms of constraints, which are quadratic as a rule.
pub(super) fn constraint<D: Scalar>(x: &[D]) -> f64 {
    largest(x).max(1.0).powi(2)
}

/// Size of the terms of constraints' rates along a velocity.
pub(super) fn constraint_rate<D: Scalar>(x: &[D], v_dot: &[D]) -> f64 {
    largest(x).max(1.0) * largest(v_dot)
}

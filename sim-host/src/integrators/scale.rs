//! What residuals are differences of, and so what their round-off is relative to.

use crate::mechanics::{Momenta, Scalar};

/// Largest absolute value, above zero.
pub(super) fn largest<D: Scalar>(values: &[D]) -> f64 {
    values.iter().fold(f64::MIN_POSITIVE, |m, x| m.max(x.re().abs()))
}

/// Size of the terms of constraints, which are quadratic as a rule.
pub(super) fn constraint<D: Scalar>(x: &[D]) -> f64 {
    largest(x).max(1.0).powi(2)
}

/// Largest momentum and speed so far: a motion that begins at rest, or comes to it, has none to go by.
#[derive(Clone, Copy, Debug)]
pub(super) struct Largest {
    pub momentum: f64,
    pub speed: f64,
}

impl Largest {
    /// Of a first step's momenta at both ends, which its forces tell apart, and its velocity. At rest
    /// without forces nothing moves, and any scale does.
    pub fn new<D: Scalar, const N: usize>(momenta: &Momenta<N, D>, v_dot: &[D]) -> Self {
        let momentum = largest(&momenta.begin).max(largest(&momenta.end));
        Self { momentum, speed: largest(v_dot) }
    }

    pub fn update<D: Scalar>(&mut self, momentum: &[D], d: &[D]) {
        self.momentum = self.momentum.max(largest(momentum));
        self.speed = self.speed.max(largest(d));
    }

    /// Size of the terms of constraints' rates, `Dg d`.
    pub fn constraint_rate<D: Scalar>(&self, x: &[D]) -> f64 {
        largest(x).max(1.0) * self.speed
    }
}

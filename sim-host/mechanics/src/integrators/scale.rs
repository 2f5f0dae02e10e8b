//! What residuals are differences of, and so what their round-off is relative to.
//!
//! # Notation
//! `i` a coordinate, `K` the derivative of a step's first momentum with respect to its mean velocity `d`, which is the
//! mass matrix but for forces; `p, p⁺` the momenta at a step's ends; `G` the constraints' derivatives.
//! ```text
//! E = Σ |p_i d_i| + Σ (p⁺_i − p_i)²/K_ii        twice an energy: of the motion, and of what pushes it   (1)
//! √(K_ii E)                                     of the momentum of i                                   (2)
//! Σ |G_ci| (|x_i| + h |d_i|)                    of the constraint c: twice its terms where it is quadratic (3)
//! Σ |G_ci| √(E/K_ii)                            of its rate                                            (4)
//! ```
//! A coordinate in metres and one in radians have scales of their own. `E` and `K` are the largest so far of steps that
//! have been made: a motion that begins at rest, or comes to it, has none to go by. At rest without forces nothing moves,
//! and any scale does.

use crate::{Momenta, Scalar};

/// Largest absolute value, above zero.
pub(super) fn largest<D: Scalar>(values: &[D]) -> f64 {
    values.iter().fold(f64::MIN_POSITIVE, |m, x| m.max(x.re().abs()))
}

/// (3), at a configuration from which a step moves by this.
pub(super) fn constraints<D: Scalar, const N: usize, const C: usize>(
    g: &[[D; N]; C],
    x: &[D; N],
    way: impl Fn(usize) -> D,
) -> [f64; C] {
    let size = |i: usize| x[i].re().abs() + way(i).re().abs();
    g.each_ref().map(|row| {
        let terms = row.iter().enumerate().map(|(i, g)| g.re().abs() * size(i));
        terms.sum::<f64>().max(f64::MIN_POSITIVE)
    })
}

/// Share of the largest inertia that a coordinate's is taken to have at least: one without any where a step begins, like
/// a quaternion's scalar, has some before it ends.
const LEAST: f64 = 1e-2;

/// `K_ii` and `E`, the largest so far.
#[derive(Clone, Copy, Debug)]
pub(super) struct Largest<const N: usize> {
    inertia: [f64; N],
    energy: f64,
}

impl<const N: usize> Largest<N> {
    /// Of a first step's momenta at both ends, which its forces tell apart, and its velocity.
    pub fn new<D: Scalar>(momenta: &Momenta<N, D>, d: &[D; N]) -> Self {
        let mut all = Self { inertia: [f64::MIN_POSITIVE; N], energy: 0.0 };
        all.update(|i| momenta.stiffness[i][i], [&momenta.begin, &momenta.end], d);
        all
    }

    /// A step has been made.
    pub fn update<D: Scalar>(
        &mut self,
        inertia: impl Fn(usize) -> D,
        [begin, end]: [&[D; N]; 2],
        d: &[D],
    ) {
        for i in 0..N {
            self.inertia[i] = self.inertia[i].max(inertia(i).re().abs());
        }
        let energy = (0..N).map(|i| {
            let (begin, end) = (begin[i].re(), end[i].re());
            let moved = begin.abs().max(end.abs()) * d[i].re().abs();
            moved + (end - begin).powi(2) / self.inertia_of(i)
        });
        self.energy = self.energy.max(energy.sum());
    }

    fn inertia_of(&self, i: usize) -> f64 {
        self.inertia[i].max(LEAST * largest(&self.inertia))
    }

    /// (2)
    pub fn momentum(&self, i: usize) -> f64 {
        (self.inertia_of(i) * self.energy).sqrt().max(f64::MIN_POSITIVE)
    }

    /// (4)
    pub fn rate<D: Scalar>(&self, g: &[D; N]) -> f64 {
        let each = (0..N).map(|i| g[i].re().abs() * (self.energy / self.inertia_of(i)).sqrt());
        each.sum::<f64>().max(f64::MIN_POSITIVE)
    }
}

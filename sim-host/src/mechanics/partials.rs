//! Exact derivatives of discrete Lagrangians and constraints, by hyper-dual numbers (Fike and Alonso
//! 2011): no difference quotients, so no step to choose.

use super::{DiscreteLagrangian, Scalar};
use num_dual::{Dual64, HyperDual64};

/// The discrete momenta of a step from `x` with mean velocity `d`: the fibre derivatives (2.4) at both
/// its ends, scaled so that they tend to `D₂L` as the step does to zero (§2.3.6).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Momenta<const N: usize> {
    /// `−h D₂𝕃(y, x)`: momentum at the beginning, in `x`.
    pub begin: [f64; N],
    /// `h D₁𝕃(y, x)`: momentum at the end, in `y`.
    pub end: [f64; N],
    /// Derivative of `begin` with respect to `d`, by rows: `−h² D₁₂𝕃` of (2.43).
    pub stiffness: [[f64; N]; N],
}

/// All [`Momenta`] of a step.
///
/// # Cost
/// N² evaluations of `𝕃` in hyper-dual numbers.
pub fn momenta<const N: usize, const C: usize>(
    system: &impl DiscreteLagrangian<N, C>,
    x: &[f64; N],
    d: &[f64; N],
    h: f64,
) -> Momenta<N> {
    let mut all = Momenta { begin: [0.0; N], end: [0.0; N], stiffness: [[0.0; N]; N] };
    let mut x_dual = x.map(HyperDual64::from_re);
    let mut d_dual = d.map(HyperDual64::from_re);
    for i in 0..N {
        // −h D₂𝕃 is the derivative along x at a fixed y = x + h d.
        x_dual[i].eps1 = -h;
        d_dual[i].eps1 = 1.0;
        for j in 0..N {
            d_dual[j].eps2 = 1.0;
            let value = system.discrete_lagrangian(&x_dual, &d_dual, h);
            all.begin[i] = value.eps1;
            all.end[j] = value.eps2;
            all.stiffness[i][j] = value.eps1eps2;
            d_dual[j].eps2 = 0.0;
        }
        x_dual[i].eps1 = 0.0;
        d_dual[i].eps1 = 0.0;
    }
    all
}

/// A function's values and its Jacobian by rows, such as `g(v)` and `Dg(v)`.
pub fn jacobian<const N: usize, const C: usize>(
    v: &[f64; N],
    function: impl Fn(&[Dual64; N]) -> [Dual64; C],
) -> ([f64; C], [[f64; N]; C]) {
    let mut values = [0.0; C];
    let mut rows = [[0.0; N]; C];
    let mut dual = v.map(Dual64::from_re);
    for j in 0..N {
        dual[j].eps = 1.0;
        for ((value, row), g) in values.iter_mut().zip(&mut rows).zip(function(&dual)) {
            *value = g.re;
            row[j] = g.eps;
        }
        dual[j].eps = 0.0;
    }
    (values, rows)
}

/// Gradient and Hessian of a function.
pub fn hessian<const N: usize>(
    v: &[f64; N],
    function: impl Fn(&[HyperDual64; N]) -> HyperDual64,
) -> ([f64; N], [[f64; N]; N]) {
    let mut gradient = [0.0; N];
    let mut hessian = [[0.0; N]; N];
    let mut dual = v.map(HyperDual64::from_re);
    for i in 0..N {
        dual[i].eps1 = 1.0;
        for j in 0..=i {
            dual[j].eps2 = 1.0;
            let value = function(&dual);
            gradient[i] = value.eps1;
            hessian[i][j] = value.eps1eps2;
            hessian[j][i] = value.eps1eps2;
            dual[j].eps2 = 0.0;
        }
        dual[i].eps1 = 0.0;
    }
    (gradient, hessian)
}

/// `a + λᵀ b`, as constraints enter beside a potential.
pub fn augmented<D: Scalar, const C: usize>(a: D, lambda: &[f64; C], b: [D; C]) -> D {
    b.into_iter().zip(lambda).fold(a, |sum, (b, lambda)| sum + b * *lambda)
}

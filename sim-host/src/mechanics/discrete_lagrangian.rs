//! Discrete Lagrangians `𝕃(y, x)`, with `y = v_{k+1}` and `x = v_k`.

use super::{Lagrangian, Scalar, jacobian, momenta};
use num_dual::Dual64;

/// A discrete system: `𝕃` on `V × V`, and constraints.
///
/// The step is given by where it begins and its mean velocity, `d = (y − x)/h`, as the difference of
/// two nearby positions has lost the digits that a small step needs.
pub trait DiscreteLagrangian<const N: usize, const C: usize> {
    /// `𝕃(x + h d, x)` for a step of `h` seconds.
    fn discrete_lagrangian<D: Scalar>(&self, x: &[D; N], d: &[D; N], h: f64) -> D;

    /// `g(v)`
    fn constraints<D: Scalar>(&self, v: &[D; N]) -> [D; C];

    /// The momentum from which a motion with velocity `v_dot` at `x` starts without spoiling the
    /// method's order.
    fn start(&self, x: &[f64; N], v_dot: &[f64; N], _h: f64) -> [f64; N]
    where
        Self: Sized,
    {
        // For a step of no length this is D₂L.
        momenta(self, x, v_dot, 0.0).begin
    }
}

/// `𝕃(y, x) = L((y + x)/2, (y − x)/h)` (2.23): of second order.
#[derive(Clone, Copy, Debug)]
pub struct Midpoint<L>(pub L);

/// `𝕃(y, x) = L(y, (y − x)/h)` (2.45): of first order for a general Lagrangian; SHAKE's positions for
/// natural ones.
#[derive(Clone, Copy, Debug)]
pub struct Endpoint<L>(pub L);

impl<const N: usize, const C: usize, L: Lagrangian<N, C>> DiscreteLagrangian<N, C> for Midpoint<L> {
    fn discrete_lagrangian<D: Scalar>(&self, x: &[D; N], d: &[D; N], h: f64) -> D {
        self.0.lagrangian(&along(x, d, 0.5 * h), d)
    }

    fn constraints<D: Scalar>(&self, v: &[D; N]) -> [D; C] {
        self.0.constraints(v)
    }
}

impl<const N: usize, const C: usize, L: Lagrangian<N, C>> DiscreteLagrangian<N, C> for Endpoint<L> {
    fn discrete_lagrangian<D: Scalar>(&self, x: &[D; N], d: &[D; N], h: f64) -> D {
        self.0.lagrangian(&along(x, d, h), d)
    }

    fn constraints<D: Scalar>(&self, v: &[D; N]) -> [D; C] {
        self.0.constraints(v)
    }

    /// This method's momentum at `x` lacks half a step of the force there: `D₂L + h/2 D₁L`.
    fn start(&self, x: &[f64; N], v_dot: &[f64; N], h: f64) -> [f64; N] {
        let momentum = momenta(self, x, v_dot, 0.0).begin;
        let v_dot = v_dot.map(Dual64::from_re);
        let (_, [force]) = jacobian(x, |x| [self.0.lagrangian(x, &v_dot)]);
        std::array::from_fn(|i| momentum[i] + 0.5 * h * force[i])
    }
}

fn along<D: Scalar, const N: usize>(x: &[D; N], d: &[D; N], time: f64) -> [D; N] {
    std::array::from_fn(|i| x[i] + d[i] * time)
}

//! Discrete Lagrangians `𝕃(y, x)`, with `y = v_{k+1}` and `x = v_k`.

use super::{Lagrangian, Momenta, Scalar, differentiation, jacobian};
use num_dual::Dual;

/// A discrete system: `𝕃` on `V × V`, constraints, and forces.
///
/// The step is given by where it begins and its mean velocity, `d = (y − x)/h`, as the difference of
/// two nearby positions has lost the digits that a small step needs.
pub trait DiscreteLagrangian<const N: usize, const C: usize> {
    /// `𝕃(x + h d, x)` for a step of `h` seconds.
    fn discrete_lagrangian<D: Scalar>(&self, x: &[D; N], d: &[D; N], h: f64) -> D;

    /// `g(v)`
    fn constraints<D: Scalar>(&self, v: &[D; N]) -> [D; C];

    /// Impulses of forces at the step's beginning and end, whose sum is that of the step.
    fn impulses<D: Scalar>(&self, _x: &[D; N], _d: &[D; N], _h: f64) -> Option<[[D; N]; 2]> {
        None
    }

    /// [`Momenta`] of a step without forces.
    ///
    /// # Cost
    /// N² evaluations of `𝕃` in hyper-dual numbers, unless a system writes its own.
    fn derivatives<D: Scalar>(&self, x: &[D; N], d: &[D; N], h: f64) -> Momenta<N, D> {
        // −h D₂𝕃 is the derivative along x at a fixed y = x + h d, h D₁𝕃 that along d.
        differentiation::momenta(x, d, [-h, 1.0], [0.0, 1.0], |x, d| {
            self.discrete_lagrangian(x, d, h)
        })
    }

    /// The momentum (`begin`) from which a motion with velocity `v_dot` at `x` starts without spoiling
    /// the method's order, and its derivative with respect to `v_dot` (`stiffness`).
    fn start<D: Scalar>(&self, x: &[D; N], v_dot: &[D; N], _h: f64) -> Momenta<N, D> {
        // For a step of no length this is D₂L.
        self.derivatives(x, v_dot, 0.0)
    }

    /// All [`Momenta`] of a step. Forces enter as potentials do: (5.3).
    fn momenta<D: Scalar>(&self, x: &[D; N], d: &[D; N], h: f64) -> Momenta<N, D> {
        let mut all = self.derivatives(x, d, h);
        if let Some([begin, end]) = self.impulses(x, d, h) {
            let x = x.map(Dual::from_re);
            let (_, change) = jacobian(d, |d| {
                self.impulses(&x, d, h).map_or([Dual::from_re(D::from(0.0)); N], |[begin, _]| begin)
            });
            for i in 0..N {
                all.begin[i] -= begin[i];
                all.end[i] += end[i];
                for j in 0..N {
                    all.stiffness[i][j] -= change[i][j];
                }
            }
        }
        all
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

    /// (5.2)
    fn impulses<D: Scalar>(&self, x: &[D; N], d: &[D; N], h: f64) -> Option<[[D; N]; 2]> {
        let half = self.0.force(&along(x, d, 0.5 * h), d)?.map(|force| force * (0.5 * h));
        Some([half, half])
    }

    fn derivatives<D: Scalar>(&self, x: &[D; N], d: &[D; N], h: f64) -> Momenta<N, D> {
        self.0.slopes(&along(x, d, 0.5 * h), d, -0.5 * h, 0.5 * h)
    }
}

impl<const N: usize, const C: usize, L: Lagrangian<N, C>> DiscreteLagrangian<N, C> for Endpoint<L> {
    fn discrete_lagrangian<D: Scalar>(&self, x: &[D; N], d: &[D; N], h: f64) -> D {
        self.0.lagrangian(&along(x, d, h), d)
    }

    fn constraints<D: Scalar>(&self, v: &[D; N]) -> [D; C] {
        self.0.constraints(v)
    }

    /// All of it at the end, where the potential's is.
    fn impulses<D: Scalar>(&self, x: &[D; N], d: &[D; N], h: f64) -> Option<[[D; N]; 2]> {
        let force = self.0.force(&along(x, d, h), d)?;
        Some([[D::from(0.0); N], force.map(|force| force * h)])
    }

    fn derivatives<D: Scalar>(&self, x: &[D; N], d: &[D; N], h: f64) -> Momenta<N, D> {
        self.0.slopes(&along(x, d, h), d, 0.0, h)
    }

    /// This method's momentum at `x` has half a step of the force there ahead of it:
    /// `D₂L + h/2 (D₁L + F)`.
    fn start<D: Scalar>(&self, x: &[D; N], v_dot: &[D; N], h: f64) -> Momenta<N, D> {
        let mut start = self.0.slopes(x, v_dot, 0.5 * h, 0.0);
        if let Some(force) = self.0.force(x, v_dot) {
            for i in 0..N {
                start.begin[i] += force[i] * (0.5 * h);
            }
        }
        start
    }
}

fn along<D: Scalar, const N: usize>(x: &[D; N], d: &[D; N], time: f64) -> [D; N] {
    std::array::from_fn(|i| x[i] + d[i] * time)
}

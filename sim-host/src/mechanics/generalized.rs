//! Generalized coordinates through a chart (§2.3.2).

use super::{DiscreteLagrangian, Scalar};

/// A chart of the configuration manifold: `M` coordinates to a point of `V = ℝᴺ`.
pub trait Chart<const M: usize, const N: usize> {
    /// `ψ(q)`
    fn embed<D: Scalar>(&self, q: &[D; M]) -> [D; N];
}

/// The constrained discrete Lagrangian `𝕃ᶜ(q₁, q₀) = 𝕃(ψ(q₁), ψ(q₀))` (2.38) of a system seen through a
/// chart, in which it has no constraints.
#[derive(Clone, Copy, Debug)]
pub struct Generalized<S, K, const N: usize, const C: usize> {
    /// The system in `V`.
    pub system: S,
    /// The chart.
    pub chart: K,
}

impl<S, K, const M: usize, const N: usize, const C: usize> DiscreteLagrangian<M, 0>
    for Generalized<S, K, N, C>
where
    S: DiscreteLagrangian<N, C>,
    K: Chart<M, N>,
{
    fn discrete_lagrangian<D: Scalar>(&self, x: &[D; M], d: &[D; M], h: f64) -> D {
        let begin = self.chart.embed(x);
        let end = self.chart.embed(&std::array::from_fn(|i| x[i] + d[i] * h));
        let velocity = std::array::from_fn(|i| (end[i] - begin[i]) * (1.0 / h));
        self.system.discrete_lagrangian(&begin, &velocity, h)
    }

    fn constraints<D: Scalar>(&self, _: &[D; M]) -> [D; 0] {
        []
    }
}

//! Generalized coordinates through a chart (§2.3.2).

use super::{DiscreteLagrangian, Momenta, Scalar, jacobian};

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
        let (begin, _, velocity) = embedded(&self.chart, x, d, h);
        self.system.discrete_lagrangian(&begin, &velocity, h)
    }

    fn constraints<D: Scalar>(&self, _: &[D; M]) -> [D; 0] {
        []
    }

    fn impulses<D: Scalar>(&self, x: &[D; M], d: &[D; M], h: f64) -> Option<[[D; M]; 2]> {
        let (begin, end, velocity) = embedded(&self.chart, x, d, h);
        let [at_begin, at_end] = self.system.impulses(&begin, &velocity, h)?;
        let (_, slope_begin) = jacobian(x, |q| self.chart.embed(q));
        let (_, slope_end) = jacobian(&end, |q| self.chart.embed(q));
        Some([pulled_back(&slope_begin, &at_begin), pulled_back(&slope_end, &at_end)])
    }

    /// `Dψᵀ` of the system's.
    fn start<D: Scalar>(&self, x: &[D; M], v_dot: &[D; M], h: f64) -> Momenta<M, D> {
        let (point, slope) = jacobian(x, |q| self.chart.embed(q));
        let velocity = slope.map(|row| (0..M).map(|i| row[i] * v_dot[i]).sum());
        let start = self.system.start(&point, &velocity, h);
        // Rows of (stiffness Dψ)ᵀ, each pulled back.
        let columns: [[D; M]; M] = std::array::from_fn(|j| {
            let column = start.stiffness.map(|row| (0..N).map(|k| row[k] * slope[k][j]).sum());
            pulled_back(&slope, &column)
        });
        Momenta {
            begin: pulled_back(&slope, &start.begin),
            end: pulled_back(&slope, &start.end),
            stiffness: std::array::from_fn(|i| columns.map(|column| column[i])),
        }
    }
}

/// `ψ(x)`, the end in the chart, and `(ψ(x + h d) − ψ(x))/h`.
fn embedded<D: Scalar, const M: usize, const N: usize>(
    chart: &impl Chart<M, N>,
    x: &[D; M],
    d: &[D; M],
    h: f64,
) -> ([D; N], [D; M], [D; N]) {
    let begin = chart.embed(x);
    let end_in_chart = std::array::from_fn(|i| x[i] + d[i] * h);
    let end = chart.embed(&end_in_chart);
    let velocity = std::array::from_fn(|i| (end[i] - begin[i]) * (1.0 / h));
    (begin, end_in_chart, velocity)
}

/// `Dψᵀ f`
fn pulled_back<D: Scalar, const M: usize, const N: usize>(
    slope: &[[D; M]; N],
    covector: &[D; N],
) -> [D; M] {
    std::array::from_fn(|i| (0..N).map(|k| slope[k][i] * covector[k]).sum())
}

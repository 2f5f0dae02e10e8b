//! The action of a discrete path.

use super::{DiscreteLagrangian, Scalar};

/// The action sum (2.1), `𝕊 = Σ 𝕃(v_{k+1}, v_k)`, whose extremum among paths with the same ends is the
/// discrete motion.
pub fn action_sum<D: Scalar, const N: usize, const C: usize>(
    system: &impl DiscreteLagrangian<N, C>,
    path: &[[D; N]],
    h: f64,
) -> D {
    path.windows(2)
        .map(|step| {
            let d = std::array::from_fn(|i| (step[1][i] - step[0][i]) * (1.0 / h));
            system.discrete_lagrangian(&step[0], &d, h)
        })
        .sum()
}

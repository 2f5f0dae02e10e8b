//! What SHAKE and RATTLE share: a drift with a momentum that constraint forces at its beginning
//! correct, so that its end is on the manifold.
//!
//! ```text
//! π = p + s Gᵀ(x) γ,   y = x + h M⁻¹ π,   g(y) = 0                        (1), in γ alone
//! ```

use super::branch::on_branch_of_short_steps;
use super::{Progress, StepError, scale};
use crate::newton::{Evaluation, solve};
use crate::{Natural, Scalar, jacobian};

/// A drift.
#[derive(Clone, Debug)]
pub(super) struct Drift<D, const N: usize, const C: usize> {
    /// `γ`
    pub gamma: [D; C],
    /// `π`
    pub momentum: [D; N],
    /// `y`
    pub end: [D; N],
    /// `G(y)`
    pub g_end: [[D; N]; C],
}

/// Solves (1), from the `γ` of a drift before.
pub(super) fn constrained_drift<D: Scalar, const N: usize, const C: usize>(
    system: &impl Natural<N, C>,
    (x, g): (&[D; N], &[[D; N]; C]),
    p: &[D; N],
    s: f64,
    gamma: [D; C],
    progress: &mut Progress,
) -> Result<Drift<D, N, C>, StepError> {
    let h = progress.h;
    let masses = system.masses();
    let extents = scale::constraints(g, x, |i| p[i] * (h / masses[i]));
    let root = solve(gamma, &extents, |gamma| {
        let momentum: [D; N] =
            std::array::from_fn(|i| (0..C).fold(p[i], |sum, c| sum + g[c][i] * gamma[c] * s));
        let end = std::array::from_fn(|i| x[i] + momentum[i] * (h / masses[i]));
        let (residual, g_end) = jacobian(&end, |q| system.constraints(q));
        let jacobian = compliance(&g_end, g, &masses, h * s);
        Evaluation { residual, jacobian, known: (momentum, end, g_end) }
    })
    .map_err(|failure| progress.error(failure))?;
    on_branch_of_short_steps(&root.at.jacobian).map_err(|failure| progress.error(failure))?;
    let finite = root.at.known.1.iter().all(|x| x.re().is_finite());
    if !finite {
        return Err(progress.error(crate::newton::NewtonFailure::NotFinite));
    }
    progress.solved(&root);
    let (momentum, end, g_end) = root.at.known;
    Ok(Drift { gamma: root.x, momentum, end, g_end })
}

/// `factor · A M⁻¹ Bᵀ`
pub(super) fn compliance<D: Scalar, const N: usize, const C: usize>(
    a: &[[D; N]; C],
    b: &[[D; N]; C],
    masses: &[f64; N],
    factor: f64,
) -> [[D; C]; C] {
    std::array::from_fn(|i| {
        std::array::from_fn(|j| (0..N).map(|k| a[i][k] * b[j][k] * (factor / masses[k])).sum())
    })
}

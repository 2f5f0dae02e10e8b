//! Projection onto the constraints, nearest in the kinetic metric.
//!
//! ```text
//! M δ = Gᵀ(x) μ,   g(x + δ) = 0;      M (v̇ − v) = Gᵀ ν,   G v̇ = 0
//! ```

use super::{Progress, StepError, scale};
use crate::newton::{Evaluation, NewtonFailure, solve, solve_linear};
use crate::{Lagrangian, Scalar, jacobian, saddle};

/// The nearest configuration on the manifold, and the nearest velocity along it there.
pub(super) fn projected<S, D: Scalar, const N: usize, const C: usize, const U: usize>(
    system: &S,
    x: [D; N],
    v_dot: [D; N],
    progress: &mut Progress,
) -> Result<([D; N], [D; N]), StepError>
where
    S: Lagrangian<N, C>,
{
    let (inertia, _) = system.inertia_and_force(&x, &v_dot);
    let (_, g) = jacobian(&x, |v| system.constraints(v));
    let mass = inertia.iter().fold(f64::MIN_POSITIVE, |m, row| m.max(scale::largest(row)));
    let extents = scale::constraints(&g, &x, |_| D::from(0.0));
    let length = scale::largest(&x);
    let scale = std::array::from_fn(|i| if i < N { mass * length } else { extents[i - N] });
    let root = solve([D::from(0.0); U], &scale, |unknowns: &[D; U]| {
        let delta: [D; N] = std::array::from_fn(|i| unknowns[i]);
        let y: [D; N] = std::array::from_fn(|i| x[i] + delta[i]);
        let (values, g_end) = jacobian(&y, |v| system.constraints(v));
        let residual = std::array::from_fn(|i| match i.checked_sub(N) {
            Some(c) => values[c],
            None => {
                let pulled: D = (0..N).map(|j| inertia[i][j] * delta[j]).sum();
                (0..C).fold(pulled, |sum, c| sum - g[c][i] * unknowns[N + c])
            }
        });
        Evaluation {
            residual,
            jacobian: saddle(&inertia, &g, -1.0, &g_end, 1.0),
            known: (y, g_end),
        }
    })
    .map_err(|failure| progress.error(failure))?;
    progress.solved(&root);
    let (y, g) = root.at.known;
    let right = std::array::from_fn(|i| {
        if i < N { (0..N).map(|j| inertia[i][j] * v_dot[j]).sum() } else { D::from(0.0) }
    });
    let solution = solve_linear::<D, U>(saddle(&inertia, &g, -1.0, &g, 1.0), right)
        .map_err(|pivot| progress.error(NewtonFailure::SingularJacobian { pivot }))?;
    Ok((y, std::array::from_fn(|i| solution[i])))
}

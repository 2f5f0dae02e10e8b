//! Tangent maps of steps, exactly: how a step's end moves with its beginning.
//!
//! # Notation
//! A step takes `(x, p)` to `(y, p⁺)` by `p⁻(x, d) = p`, `y = x + h d`, `p⁺ = p⁺(x, d)`.
//!
//! ```text
//! δd = (∂p⁻/∂d)⁻¹ (δp − ∂p⁻/∂x δx),   δy = δx + h δd,   δp⁺ = ∂p⁺/∂x δx + ∂p⁺/∂d δd      (1)
//! ```

use super::DiscreteLagrangian;
use crate::newton::solve_linear;
use num_dual::HyperDual64;

/// A displacement of configuration and momentum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Displacement<const N: usize> {
    /// `δx`
    pub configuration: [f64; N],
    /// `δp`
    pub momentum: [f64; N],
}

/// What a displacement at a step's beginning is at its end; `None` where the step's equations are
/// singular. For systems without constraints, such as those seen through a chart.
pub fn carried<const N: usize>(
    system: &impl DiscreteLagrangian<N, 0>,
    x: &[f64; N],
    d: &[f64; N],
    h: f64,
    at: &Displacement<N>,
) -> Option<Displacement<N>> {
    // Mixed second derivatives: along p⁻ (x by −h, d by 1) or p⁺ (d) first, then along (δx, δd).
    let change = |i: usize, at_begin: f64, dx: &[f64; N], dd: &[f64; N]| {
        let x = std::array::from_fn(|k| {
            HyperDual64::new(x[k], if k == i { at_begin } else { 0.0 }, dx[k], 0.0)
        });
        let d = std::array::from_fn(|k| {
            HyperDual64::new(d[k], if k == i { 1.0 } else { 0.0 }, dd[k], 0.0)
        });
        system.discrete_lagrangian(&x, &d, h).eps1eps2
    };
    let still = [0.0; N];
    let stiffness = std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let mut unit = still;
            unit[j] = 1.0;
            change(i, -h, &still, &unit)
        })
    });
    // (1)
    let dx = &at.configuration;
    let wanted = std::array::from_fn(|i| at.momentum[i] - change(i, -h, dx, &still));
    let dd = solve_linear(stiffness, wanted).ok()?;
    Some(Displacement {
        configuration: std::array::from_fn(|i| dx[i] + h * dd[i]),
        momentum: std::array::from_fn(|i| change(i, 0.0, dx, &dd)),
    })
}

/// The canonical symplectic form (2.10) of two displacements: `δ₁x · δ₂p − δ₂x · δ₁p`.
pub fn symplectic_form<const N: usize>(a: &Displacement<N>, b: &Displacement<N>) -> f64 {
    (0..N).map(|i| a.configuration[i] * b.momentum[i] - b.configuration[i] * a.momentum[i]).sum()
}

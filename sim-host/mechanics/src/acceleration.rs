//! The differential equations: Euler and Lagrange's, constraints differentiated twice.
//!
//! # Notation
//! `M = D₂₂L`, `f = D₁L − D₁₂L v̇ + F`, `G = Dg`
//!
//! ```text
//! [ M  −Gᵀ ] [ a ]   [      f      ]
//! [ G   0  ] [ λ ] = [ −D²g(v̇, v̇) ]      (1)
//! ```

use super::{Lagrangian, Scalar, bend, jacobian};
use crate::newton::{NewtonFailure, solve_linear};

/// The acceleration by (1).
///
/// # Errors
/// A singular Jacobian where the constraints are dependent, or a number is not finite.
pub fn acceleration<S, D: Scalar, const N: usize, const C: usize, const U: usize>(
    system: &S,
    x: &[D; N],
    v_dot: &[D; N],
) -> Result<[D; N], NewtonFailure>
where
    S: Lagrangian<N, C>,
{
    let (inertia, mut force) = system.inertia_and_force(x, v_dot);
    if let Some(external) = system.force(x, v_dot) {
        for (force, external) in force.iter_mut().zip(external) {
            *force += external;
        }
    }
    let (_, g) = jacobian(x, |v| system.constraints(v));
    let bend = bend(x, v_dot, |v| system.constraints(v));
    let right = std::array::from_fn(|i| if i < N { force[i] } else { -bend[i - N] });
    let solution = solve_linear::<D, U>(saddle(&inertia, &g, -1.0, &g, 1.0), right)
        .map_err(|pivot| NewtonFailure::SingularJacobian { pivot })?;
    Ok(std::array::from_fn(|i| solution[i]))
}

/// `[ A  s Bᵀ ; t C  0 ]`, the matrix of equations with constraints.
pub fn saddle<D: Scalar, const N: usize, const C: usize, const U: usize>(
    a: &[[D; N]; N],
    b: &[[D; N]; C],
    s: f64,
    c: &[[D; N]; C],
    t: f64,
) -> [[D; U]; U] {
    const { assert!(U == N + C, "unknowns are coordinates and multipliers") }
    let mut matrix = [[D::from(0.0); U]; U];
    for i in 0..N {
        matrix[i][..N].copy_from_slice(&a[i]);
        for k in 0..C {
            matrix[i][N + k] = b[k][i] * s;
            matrix[N + k][i] = c[k][i] * t;
        }
    }
    matrix
}

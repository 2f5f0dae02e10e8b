//! The classical Runge–Kutta method of fourth order on the differential equations, the usual
//! alternative: constraints differentiated twice, and so left to drift.
//!
//! # Notation
//! `M a = −DᵀV + Gᵀ λ`, `G a = −D²g(v̇, v̇)` (1); `G = Dg`

use super::StepError;
use crate::mechanics::{Natural, jacobian};
use crate::newton::{NewtonFailure, solve_linear};
use num_dual::HyperDual64;

/// A motion under the Runge–Kutta method.
#[derive(Clone, Debug)]
pub struct RungeKutta<S, const N: usize, const C: usize> {
    system: S,
    h: f64,
    x: [f64; N],
    v: [f64; N],
    steps: u64,
}

impl<S: Natural<N, C>, const N: usize, const C: usize> RungeKutta<S, N, C> {
    /// From a configuration on the manifold, and a velocity along it.
    pub fn new(system: S, h: f64, x: [f64; N], v_dot: [f64; N]) -> Self {
        Self { system, h, x, v: v_dot, steps: 0 }
    }

    /// The configuration.
    pub fn configuration(&self) -> &[f64; N] {
        &self.x
    }

    /// The velocity.
    pub fn velocity(&self) -> &[f64; N] {
        &self.v
    }

    /// One step.
    ///
    /// # Errors
    /// A [`StepError`] where the constraints are dependent, or a number is not finite.
    pub fn step(&mut self) -> Result<(), StepError> {
        let error = |failure: NewtonFailure| StepError {
            step: self.steps,
            h: self.h,
            time_s: self.steps as f64 * self.h,
            failure: failure.into(),
        };
        let h = self.h;
        let moved = |a: &[f64; N], b: &[f64; N], share: f64| -> [f64; N] {
            std::array::from_fn(|i| a[i] + share * h * b[i])
        };
        let rate = |x: &[f64; N], v: &[f64; N]| acceleration(&self.system, x, v);
        let (v1, a1) = (self.v, rate(&self.x, &self.v).map_err(error)?);
        let v2 = moved(&self.v, &a1, 0.5);
        let a2 = rate(&moved(&self.x, &v1, 0.5), &v2).map_err(error)?;
        let v3 = moved(&self.v, &a2, 0.5);
        let a3 = rate(&moved(&self.x, &v2, 0.5), &v3).map_err(error)?;
        let v4 = moved(&self.v, &a3, 1.0);
        let a4 = rate(&moved(&self.x, &v3, 1.0), &v4).map_err(error)?;
        let mean = |[a, b, c, d]: [&[f64; N]; 4]| -> [f64; N] {
            std::array::from_fn(|i| (a[i] + 2.0 * (b[i] + c[i]) + d[i]) / 6.0)
        };
        let x = moved(&self.x, &mean([&v1, &v2, &v3, &v4]), 1.0);
        let v = moved(&self.v, &mean([&a1, &a2, &a3, &a4]), 1.0);
        if !x.iter().chain(&v).all(|x| x.is_finite()) {
            return Err(error(NewtonFailure::NotFinite));
        }
        (self.x, self.v) = (x, v);
        self.steps += 1;
        Ok(())
    }
}

/// (1)
fn acceleration<const N: usize, const C: usize>(
    system: &impl Natural<N, C>,
    x: &[f64; N],
    v: &[f64; N],
) -> Result<[f64; N], NewtonFailure> {
    let masses = system.masses();
    let (_, [slope]) = jacobian(x, |q| [system.potential(q)]);
    let (_, g) = jacobian(x, |q| system.constraints(q));
    // Twice along v̇: the second derivative of g on a straight line.
    let line = std::array::from_fn(|i| HyperDual64::new(x[i], v[i], v[i], 0.0));
    let bend = system.constraints(&line).map(|g| g.eps1eps2);
    let free: [f64; N] = std::array::from_fn(|i| -slope[i] / masses[i]);
    let compliance = std::array::from_fn(|i| {
        std::array::from_fn(|j| (0..N).map(|k| g[i][k] * g[j][k] / masses[k]).sum())
    });
    let needed = std::array::from_fn(|c| -bend[c] - (0..N).map(|i| g[c][i] * free[i]).sum::<f64>());
    let lambda = solve_linear::<C>(compliance, needed)
        .map_err(|pivot| NewtonFailure::SingularJacobian { pivot })?;
    Ok(std::array::from_fn(|i| {
        free[i] + (0..C).map(|c| g[c][i] * lambda[c]).sum::<f64>() / masses[i]
    }))
}

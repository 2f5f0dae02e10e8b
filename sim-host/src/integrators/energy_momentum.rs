//! The energy-momentum method of §2.4.2 (after Gonzalez 1996), for natural systems whose potential and
//! constraints are at most quadratic: there the discrete gradients are those at the midpoint, and the
//! method is the implicit midpoint rule with the constraint at the end of the step.
//!
//! # Notation
//! `x = q_n`, `p = p_n`, `d = (q_{n+1} − q_n)/h` (the unknown: differences of positions would lose
//! the digits that a small step needs), `y = x + h d`, `m = x + h d/2`
//!
//! ```text
//! p_{n+1} = 2 M d − p
//! 2 M d − 2 p + h DᵀV(m) + h Dᵀg(m) λ = 0,   Dg(m) d = 0
//! ```
//! The last equation is `g(y) = g(x)` for a quadratic `g`, with the digits that the difference of two
//! values of `g` over a small step would lose.

use super::StepError;
use crate::mechanics::{Natural, augmented, hessian, jacobian};
use crate::newton::solve;

/// A motion under the energy-momentum method.
#[derive(Clone, Debug)]
pub struct EnergyMomentum<S, const N: usize, const C: usize, const U: usize> {
    system: S,
    h: f64,
    q: [f64; N],
    p: [f64; N],
    lambda: [f64; C],
    steps: u64,
    iterations: u64,
}

impl<S: Natural<N, C>, const N: usize, const C: usize, const U: usize> EnergyMomentum<S, N, C, U> {
    /// From a configuration on the manifold, and velocities.
    pub fn new(system: S, h: f64, q: [f64; N], q_dot: &[f64; N]) -> Self {
        const { assert!(U == N + C, "unknowns are coordinates and multipliers") }
        let masses = system.masses();
        let p = std::array::from_fn(|i| masses[i] * q_dot[i]);
        Self { system, h, q, p, lambda: [0.0; C], steps: 0, iterations: 0 }
    }

    /// The latest configuration.
    pub fn configuration(&self) -> &[f64; N] {
        &self.q
    }

    /// The latest velocities.
    pub fn velocity(&self) -> [f64; N] {
        let masses = self.system.masses();
        std::array::from_fn(|i| self.p[i] / masses[i])
    }

    /// Newton iterations a step, on average.
    pub fn mean_iterations(&self) -> f64 {
        self.iterations as f64 / self.steps.max(1) as f64
    }

    /// One step.
    ///
    /// # Errors
    /// A [`StepError`]; the motion is then where it was.
    pub fn step(&mut self) -> Result<(), StepError> {
        let Self { system, h, q: x, p, lambda, .. } = &*self;
        let h = *h;
        let masses = system.masses();
        let start = std::array::from_fn(|i| if i < N { p[i] / masses[i] } else { lambda[i - N] });
        let momentum = p.iter().fold(f64::MIN_POSITIVE, |m, p| m.max(2.0 * p.abs()));
        let extent = x.iter().fold(1.0_f64, |m, q| m.max(q.abs()));
        let speed = start[..N].iter().fold(f64::MIN_POSITIVE, |m, d| m.max(d.abs()));
        let scale = std::array::from_fn(|i| if i < N { momentum } else { extent * speed });
        let root = solve::<U>(start, &scale, |unknowns| {
            let lambda: [f64; C] = std::array::from_fn(|c| unknowns[N + c]);
            let middle: [f64; N] = std::array::from_fn(|i| x[i] + 0.5 * h * unknowns[i]);
            let (gradient, hessian) = hessian(&middle, |q| {
                augmented(system.potential(q), &lambda, system.constraints(q))
            });
            let (_, g) = jacobian(&middle, |q| system.constraints(q));
            // Derivative of Dg(x + h d/2) d with respect to d: that is Dg(x + h d), as Dg is linear.
            let end: [f64; N] = std::array::from_fn(|i| x[i] + h * unknowns[i]);
            let (_, g_end) = jacobian(&end, |q| system.constraints(q));
            let mut residual = [0.0; U];
            let mut slope = [[0.0; U]; U];
            for i in 0..N {
                residual[i] = 2.0 * masses[i] * unknowns[i] - 2.0 * p[i] + h * gradient[i];
                for j in 0..N {
                    slope[i][j] = 0.5 * h * h * hessian[i][j];
                }
                slope[i][i] += 2.0 * masses[i];
                for c in 0..C {
                    residual[N + c] += g[c][i] * unknowns[i];
                    slope[i][N + c] = h * g[c][i];
                    slope[N + c][i] = g_end[c][i];
                }
            }
            (residual, slope)
        })
        .map_err(|failure| StepError {
            step: self.steps,
            h,
            time_s: self.steps as f64 * h,
            failure: failure.into(),
        })?;
        for i in 0..N {
            self.p[i] = 2.0 * masses[i] * root.x[i] - self.p[i];
            self.q[i] += h * root.x[i];
        }
        self.lambda = std::array::from_fn(|c| root.x[N + c]);
        self.steps += 1;
        self.iterations += u64::from(root.iterations);
        Ok(())
    }
}

//! RATTLE (2.33) to (2.37), for natural systems: SHAKE's positions, and momenta that satisfy the hidden
//! constraint `Dg(v) v̇ = 0`. Without constraints it is the velocity form of Verlet's method.
//!
//! # Notation
//! `x, y` = `v_n, v_{n+1}`; `π = p_{n+1/2}`; `G = Dg`
//!
//! ```text
//! π = p − h/2 DᵀV(x) + h/2 Gᵀ(x) γ,   y = x + h M⁻¹ π,   g(y) = 0        (1)
//! p := π − h/2 DᵀV(y) + h/2 Gᵀ(y) λ,  G(y) M⁻¹ p = 0                     (2)
//! ```

use super::constrained_drift::{compliance, constrained_drift};
use super::{Integrator, Progress, StepError};
use crate::newton::{NewtonFailure, solve_linear};
use crate::{Natural, Scalar, jacobian, potential_force};

/// A motion under RATTLE.
#[derive(Clone, Debug)]
pub struct Rattle<S, const N: usize, const C: usize, D = f64> {
    system: S,
    x: [D; N],
    p: [D; N],
    gamma: [D; C],
    /// `−DᵀV(x)`
    force: [D; N],
    /// `G(x)`
    g: [[D; N]; C],
    progress: Progress,
}

impl<S: Natural<N, C>, D: Scalar, const N: usize, const C: usize> Rattle<S, N, C, D> {
    /// From a configuration on the manifold, and a velocity along it.
    pub fn new(system: S, h: f64, x: [D; N], v_dot: &[D; N]) -> Self {
        let masses = system.masses();
        let p = std::array::from_fn(|i| v_dot[i] * masses[i]);
        let force = potential_force(&system, &x);
        let (_, g) = jacobian(&x, |q| system.constraints(q));
        let gamma = [D::from(0.0); C];
        Self { system, x, p, gamma, force, g, progress: Progress::new(h) }
    }
}

impl<S: Natural<N, C>, D: Scalar, const N: usize, const C: usize> Integrator<N, D>
    for Rattle<S, N, C, D>
{
    fn step(&mut self) -> Result<(), StepError> {
        let Self { system, x, p, gamma, force, g, progress } = &*self;
        let half = 0.5 * progress.h;
        let masses = system.masses();
        let mut after = *progress;
        let kicked = std::array::from_fn(|i| p[i] + force[i] * half);
        let drift = constrained_drift(system, (x, g), &kicked, half, *gamma, &mut after)?;
        // (2)
        let g = drift.g_end;
        let force = potential_force(system, &drift.end);
        let free: [D; N] = std::array::from_fn(|i| drift.momentum[i] + force[i] * half);
        let along = g.map(|row| -> D { (0..N).map(|i| -row[i] * free[i] / masses[i]).sum() });
        let lambda = solve_linear(compliance(&g, &g, &masses, half), along)
            .map_err(|pivot| progress.error(NewtonFailure::SingularJacobian { pivot }))?;
        self.p = std::array::from_fn(|i| {
            (0..C).fold(free[i], |sum, c| sum + g[c][i] * lambda[c] * half)
        });
        (self.x, self.gamma, self.force, self.g) = (drift.end, drift.gamma, force, g);
        after.advance();
        self.progress = after;
        Ok(())
    }

    fn configuration(&self) -> &[D; N] {
        &self.x
    }

    fn velocity(&self) -> Result<[D; N], StepError> {
        let masses = self.system.masses();
        Ok(std::array::from_fn(|i| self.p[i] / masses[i]))
    }

    fn progress(&self) -> &Progress {
        &self.progress
    }
}

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

use super::StepError;
use crate::mechanics::{Natural, jacobian};
use crate::newton::{NewtonFailure, solve, solve_linear};

/// A motion under RATTLE.
#[derive(Clone, Debug)]
pub struct Rattle<S, const N: usize, const C: usize> {
    system: S,
    h: f64,
    x: [f64; N],
    p: [f64; N],
    gamma: [f64; C],
    steps: u64,
}

impl<S: Natural<N, C>, const N: usize, const C: usize> Rattle<S, N, C> {
    /// From a configuration on the manifold, and a velocity along it.
    pub fn new(system: S, h: f64, x: [f64; N], v_dot: &[f64; N]) -> Self {
        let masses = system.masses();
        let p = std::array::from_fn(|i| masses[i] * v_dot[i]);
        Self { system, h, x, p, gamma: [0.0; C], steps: 0 }
    }

    /// The configuration.
    pub fn configuration(&self) -> &[f64; N] {
        &self.x
    }

    /// The velocity, `M⁻¹ p`.
    pub fn velocity(&self) -> [f64; N] {
        let masses = self.system.masses();
        std::array::from_fn(|i| self.p[i] / masses[i])
    }

    /// One step.
    ///
    /// # Errors
    /// A [`StepError`]; the motion is then where it was.
    pub fn step(&mut self) -> Result<(), StepError> {
        let error = |failure: NewtonFailure| StepError {
            step: self.steps,
            h: self.h,
            time_s: self.steps as f64 * self.h,
            failure: failure.into(),
        };
        let Self { system, h, x, p, .. } = &*self;
        let h = *h;
        let masses = system.masses();
        let half_kick = |q: &[f64; N]| {
            let (_, [slope]) = jacobian(q, |q| [system.potential(q)]);
            slope.map(|slope| -0.5 * h * slope)
        };
        let (_, g) = jacobian(x, |q| system.constraints(q));
        let kick = half_kick(x);
        // (1), in γ alone.
        let halfway = |gamma: &[f64; C]| -> [f64; N] {
            std::array::from_fn(|i| {
                let push: f64 = g.iter().zip(gamma).map(|(g, gamma)| g[i] * gamma).sum();
                p[i] + kick[i] + 0.5 * h * push
            })
        };
        let drift = |half: &[f64; N]| -> [f64; N] {
            std::array::from_fn(|i| x[i] + h * half[i] / masses[i])
        };
        let extent = x.iter().fold(1.0_f64, |m, q| m.max(q * q));
        let root = solve::<C>(self.gamma, &[extent; C], |gamma| {
            let (values, end) = jacobian(&drift(&halfway(gamma)), |q| system.constraints(q));
            (values, scaled(&end, &g, &masses, 0.5 * h * h))
        })
        .map_err(error)?;
        let half = halfway(&root.x);
        let y = drift(&half);
        // (2)
        let (_, end) = jacobian(&y, |q| system.constraints(q));
        let kick = half_kick(&y);
        let free: [f64; N] = std::array::from_fn(|i| half[i] + kick[i]);
        let along = end.map(|row| -> f64 { (0..N).map(|i| row[i] * free[i] / masses[i]).sum() });
        let lambda = solve_linear(scaled(&end, &end, &masses, 0.5 * h), along.map(|x| -x))
            .map_err(|pivot| error(NewtonFailure::SingularJacobian { pivot }))?;
        self.p = std::array::from_fn(|i| {
            free[i] + 0.5 * h * (0..C).map(|c| end[c][i] * lambda[c]).sum::<f64>()
        });
        self.x = y;
        self.gamma = root.x;
        self.steps += 1;
        Ok(())
    }
}

/// `factor · A M⁻¹ Bᵀ`
fn scaled<const N: usize, const C: usize>(
    a: &[[f64; N]; C],
    b: &[[f64; N]; C],
    masses: &[f64; N],
    factor: f64,
) -> [[f64; C]; C] {
    std::array::from_fn(|i| {
        std::array::from_fn(|j| factor * (0..N).map(|k| a[i][k] * b[j][k] / masses[k]).sum::<f64>())
    })
}

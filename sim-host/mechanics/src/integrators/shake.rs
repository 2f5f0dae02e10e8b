//! SHAKE in positions (2.32) and in velocities (leap-frog; Leimkuhler and Skeel 1994), for natural
//! systems. Without constraints it is Verlet's method (2.31). Both forms have the same positions but
//! for round-off, of which the positions' form, a difference of differences, has more.
//!
//! # Notation
//! `w, x, y` = `v_{n−1}, v_n, v_{n+1}`; `G = Dg(x)`
//!
//! ```text
//! y = 2 x − w + h² M⁻¹ (−DᵀV(x) + Gᵀ λ),                g(y) = 0         (1), positions
//! π := π + h (−DᵀV(x) + Gᵀ λ),   y = x + h M⁻¹ π,       g(y) = 0         (2), velocities
//! ```
//! The velocity at `x` is `(y − w)/2h`, and so known a step later: the motion keeps a step ahead of
//! what it shows.

use super::constrained_drift::{Drift, constrained_drift};
use super::{Integrator, Progress, StepError};
use crate::{Natural, Scalar, jacobian, potential_force};

/// Which form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// (1)
    Positions,
    /// (2)
    Velocities,
}

/// A motion under SHAKE.
#[derive(Clone, Debug)]
pub struct Shake<S, const N: usize, const C: usize, D = f64> {
    system: S,
    form: Form,
    x: [D; N],
    v_dot: [D; N],
    /// The step from `x`, made already.
    ahead: Drift<D, N, C>,
    progress: Progress,
}

impl<S: Natural<N, C>, D: Scalar, const N: usize, const C: usize> Shake<S, N, C, D> {
    /// From a configuration on the manifold, and a velocity along it.
    ///
    /// # Errors
    /// A [`StepError`] if the first step, which RATTLE's first half gives, cannot be made.
    pub fn new(system: S, form: Form, h: f64, x: [D; N], v_dot: [D; N]) -> Result<Self, StepError> {
        let masses = system.masses();
        let mut progress = Progress::new(h);
        let force = potential_force(&system, &x);
        let p = std::array::from_fn(|i| v_dot[i] * masses[i] + force[i] * (0.5 * h));
        let (_, g) = jacobian(&x, |q| system.constraints(q));
        let gamma = [D::from(0.0); C];
        let ahead = constrained_drift(&system, (&x, &g), &p, 0.5 * h, gamma, &mut progress)?;
        Ok(Self { system, form, x, v_dot, ahead, progress })
    }

    /// From two configurations a step apart, both on the manifold. The motion is then at the first,
    /// about to make the step to the second.
    pub fn from_two(system: S, form: Form, h: f64, first: [D; N], second: [D; N]) -> Self {
        let masses = system.masses();
        let v_dot = std::array::from_fn(|i| (second[i] - first[i]) * (1.0 / h));
        let momentum = std::array::from_fn(|i| v_dot[i] * masses[i]);
        let (_, g_end) = jacobian(&second, |q| system.constraints(q));
        let ahead = Drift { gamma: [D::from(0.0); C], momentum, end: second, g_end };
        Self { system, form, x: first, v_dot, ahead, progress: Progress::new(h) }
    }

    /// Constraint forces' multipliers in the last step, `λ` of (2.32).
    pub fn multipliers(&self) -> &[D; C] {
        &self.ahead.gamma
    }

    /// Mean velocity of the step from the configuration to the next.
    pub fn mean_velocity(&self) -> [D; N] {
        let h = self.progress.h;
        std::array::from_fn(|i| (self.ahead.end[i] - self.x[i]) * (1.0 / h))
    }
}

impl<S: Natural<N, C>, D: Scalar, const N: usize, const C: usize> Integrator<N, D>
    for Shake<S, N, C, D>
{
    fn step(&mut self) -> Result<(), StepError> {
        let Self { system, form, x: w, ahead, progress, .. } = &*self;
        let h = progress.h;
        let masses = system.masses();
        let mut after = *progress;
        let x = ahead.end;
        let force = potential_force(system, &x);
        let before: [D; N] = match form {
            Form::Positions => std::array::from_fn(|i| (x[i] - w[i]) * (masses[i] / h)),
            Form::Velocities => ahead.momentum,
        };
        let kicked = std::array::from_fn(|i| before[i] + force[i] * h);
        let next =
            constrained_drift(system, (&x, &ahead.g_end), &kicked, h, ahead.gamma, &mut after)?;
        self.v_dot = std::array::from_fn(|i| match form {
            Form::Positions => (next.end[i] - w[i]) * (0.5 / h),
            Form::Velocities => (before[i] + next.momentum[i]) * (0.5 / masses[i]),
        });
        (self.x, self.ahead) = (x, next);
        after.advance();
        self.progress = after;
        Ok(())
    }

    fn configuration(&self) -> &[D; N] {
        &self.x
    }

    /// `(y − w)/2h`: along the manifold to second order, as SHAKE knows no hidden constraint.
    fn velocity(&self) -> Result<[D; N], StepError> {
        Ok(self.v_dot)
    }

    fn progress(&self) -> &Progress {
        &self.progress
    }
}

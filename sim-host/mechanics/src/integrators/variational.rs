//! The discrete Euler–Lagrange equations with constraints (2.27) and forces (5.3).
//!
//! # Notation
//! - `w, x, y` = `v_{k−1}, v_k, v_{k+1}`; `d = (y − x)/h`; `G = Dg(x)`
//! - `p⁻ = −h D₂𝕃`, `p⁺ = h D₁𝕃`: the discrete momenta of a step at its beginning and its end, forces
//!   included
//! - unknowns `(d, μ)`, `U = N + C` of them, with `μ = −h λ/h` of (2.27) scaled as a force
//!
//! ```text
//! p⁻(x, d) = p + h Gᵀ μ,   g(x + h d) = 0                             (1) = −h (2.27)
//! p := p⁺(x, d)
//! ```
//! With `p = p⁺` of the step before, (1) is the two-step form. That `p` is also the momentum of the
//! equivalent one-step form, so that a motion may begin from two configurations or from one with its
//! momentum. Writing (1) in `d` instead of `y` keeps the digits that `y − x` would lose.

use super::branch::on_branch_of_short_steps;
use super::scale::{self, Largest};
use super::{Integrator, Progress, StepError};
use crate::newton::{Evaluation, solve};
use crate::{DiscreteLagrangian, Scalar, jacobian, saddle};

/// A motion under the discrete Euler–Lagrange equations.
#[derive(Clone, Debug)]
pub struct Variational<S, const N: usize, const C: usize, const U: usize, D = f64> {
    system: S,
    x: [D; N],
    d: [D; N],
    /// `p⁺` of the last step.
    p: [D; N],
    mu: [D; C],
    largest: Largest<N>,
    pub(super) progress: Progress,
}

impl<S, D: Scalar, const N: usize, const C: usize, const U: usize> Variational<S, N, C, U, D>
where
    S: DiscreteLagrangian<N, C>,
{
    /// From two configurations a step apart, both on the manifold. The motion is then at the first,
    /// about to make the step to the second.
    pub fn from_two(system: S, h: f64, first: [D; N], second: [D; N]) -> Self {
        let d = std::array::from_fn(|i| (second[i] - first[i]) * (1.0 / h));
        let p = system.momenta(&first, &d, h).begin;
        Self::from_momentum(system, h, first, p, d)
    }

    /// From a configuration on the manifold, its momentum, and a guess of its velocity.
    pub fn from_momentum(system: S, h: f64, x: [D; N], p: [D; N], velocity: [D; N]) -> Self {
        let mut momenta = system.momenta(&x, &velocity, h);
        momenta.begin = p;
        let largest = Largest::new(&momenta, &velocity);
        let mu = [D::from(0.0); C];
        Self { system, x, d: velocity, p, mu, largest, progress: Progress::new(h) }
    }

    /// From a configuration on the manifold and its velocity, without spoiling the order.
    pub fn from_velocity(system: S, h: f64, x: [D; N], v_dot: [D; N]) -> Self {
        let p = system.start(&x, &v_dot, h).begin;
        Self::from_momentum(system, h, x, p, v_dot)
    }

    /// The momentum `p⁺` at the configuration.
    pub fn momentum(&self) -> &[D; N] {
        &self.p
    }

    /// Mean velocity of the last step.
    pub fn mean_velocity(&self) -> &[D; N] {
        &self.d
    }

    /// Constraint forces' multipliers in the last step, `λ` of (2.30).
    pub fn multipliers(&self) -> &[D; C] {
        &self.mu
    }

    /// A step of another length, which may be negative: the one-step form allows it. It counts in the
    /// statistics, but not as a step.
    ///
    /// # Errors
    /// A [`StepError`]; the motion is then where it was.
    pub(super) fn step_by(&mut self, h: f64) -> Result<(), StepError> {
        let Self { system, x, d, p, mu, largest, progress } = &*self;
        let (_, g) = jacobian(x, |v| system.constraints(v));
        let start = std::array::from_fn(|i| if i < N { d[i] } else { mu[i - N] });
        let extents = scale::constraints(&g, x, |i| d[i] * h);
        let scale =
            std::array::from_fn(|i| if i < N { largest.momentum(i) } else { extents[i - N] });
        let root = solve(start, &scale, |unknowns: &[D; U]| {
            let d: [D; N] = std::array::from_fn(|i| unknowns[i]);
            let y: [D; N] = std::array::from_fn(|i| x[i] + d[i] * h);
            let step = system.momenta(x, &d, h);
            let (values, g_end) = jacobian(&y, |v| system.constraints(v));
            let residual = std::array::from_fn(|i| match i.checked_sub(N) {
                Some(c) => values[c],
                None => (0..C).fold(step.begin[i] - p[i], |r, c| r - g[c][i] * unknowns[N + c] * h),
            });
            // (2.43) in (d, μ), times −h
            let jacobian = saddle(&step.stiffness, &g, -h, &g_end, h);
            Evaluation { residual, jacobian, known: (y, step.end) }
        })
        .map_err(|failure| progress.error(failure))?;
        on_branch_of_short_steps(&root.at.jacobian).map_err(|failure| progress.error(failure))?;
        self.d = std::array::from_fn(|i| root.x[i]);
        self.mu = std::array::from_fn(|c| root.x[N + c]);
        let (y, end) = root.at.known;
        self.largest.update(|i| root.at.jacobian[i][i], [&self.p, &end], &self.d);
        (self.x, self.p) = (y, end);
        self.progress.solved(&root);
        Ok(())
    }
}

impl<S, D: Scalar, const N: usize, const C: usize, const U: usize> Integrator<N, D>
    for Variational<S, N, C, U, D>
where
    S: DiscreteLagrangian<N, C>,
{
    fn step(&mut self) -> Result<(), StepError> {
        self.step_by(self.progress.h)?;
        self.progress.advance();
        Ok(())
    }

    fn configuration(&self) -> &[D; N] {
        &self.x
    }

    /// The velocity along the manifold from which a motion would start with this momentum, to which
    /// constraints may add their half step's impulse.
    fn velocity(&self) -> Result<[D; N], StepError> {
        let Self { system, x, d, p, largest, progress, .. } = self;
        let (_, g) = jacobian(x, |v| system.constraints(v));
        let start = std::array::from_fn(|i| if i < N { d[i] } else { D::from(0.0) });
        let scale = std::array::from_fn(|i| match i.checked_sub(N) {
            Some(c) => largest.rate(&g[c]),
            None => largest.momentum(i),
        });
        let root = solve(start, &scale, |unknowns: &[D; U]| {
            let v_dot: [D; N] = std::array::from_fn(|i| unknowns[i]);
            let start = system.start(x, &v_dot, progress.h);
            let residual = std::array::from_fn(|i| match i.checked_sub(N) {
                Some(c) => (0..N).map(|i| g[c][i] * v_dot[i]).sum(),
                None => (0..C).fold(start.begin[i] - p[i], |r, c| r - g[c][i] * unknowns[N + c]),
            });
            let jacobian = saddle(&start.stiffness, &g, -1.0, &g, 1.0);
            Evaluation { residual, jacobian, known: v_dot }
        })
        .map_err(|failure| progress.error(failure))?;
        Ok(root.at.known)
    }

    fn progress(&self) -> &Progress {
        &self.progress
    }
}

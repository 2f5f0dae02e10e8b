//! The implicit midpoint rule, with constraint forces taken at the midpoint and constraints met at the
//! end. Without constraints it is the variational method of (2.23); with quadratic ones and a linear
//! potential, the energy-momentum method of §2.4.2.
//!
//! # Notation
//! `x, y` = `v_n, v_{n+1}`; `d = (y − x)/h`; `m = (x + y)/2`; unknowns `(d, λ)`
//!
//! ```text
//! D₂L(m, d) − h/2 (D₁L(m, d) + F(m, d) + Dgᵀ(m) λ) = p,   g(y) = 0       (1)
//! p := D₂L(m, d) + h/2 (D₁L(m, d) + F(m, d) + Dgᵀ(m) λ)
//! ```

use super::branch::on_branch_of_short_steps;
use super::scale::{self, Largest};
use super::{Integrator, Progress, StepError, Variational};
use crate::newton::{Evaluation, solve};
use crate::{
    DiscreteLagrangian, Lagrangian, Midpoint, Scalar, augmented, hessian, jacobian, saddle,
};
use num_dual::HyperDual;

/// A motion under the implicit midpoint rule.
#[derive(Clone, Debug)]
pub struct ImplicitMidpoint<S, const N: usize, const C: usize, const U: usize, D = f64> {
    system: Midpoint<S>,
    x: [D; N],
    d: [D; N],
    p: [D; N],
    lambda: [D; C],
    largest: Largest<N>,
    progress: Progress,
}

impl<S, D: Scalar, const N: usize, const C: usize, const U: usize> ImplicitMidpoint<S, N, C, U, D>
where
    S: Lagrangian<N, C>,
{
    /// From a configuration on the manifold, and a velocity along it.
    pub fn new(system: S, h: f64, x: [D; N], v_dot: [D; N]) -> Self {
        let system = Midpoint(system);
        let p = system.start(&x, &v_dot, h).begin;
        let lambda = [D::from(0.0); C];
        let largest = Largest::new(&system.momenta(&x, &v_dot, h), &v_dot);
        Self { system, x, d: v_dot, p, lambda, largest, progress: Progress::new(h) }
    }
}

impl<S, D: Scalar, const N: usize, const C: usize, const U: usize> Integrator<N, D>
    for ImplicitMidpoint<S, N, C, U, D>
where
    S: Lagrangian<N, C> + Clone,
{
    fn step(&mut self) -> Result<(), StepError> {
        let Self { system, x, d, p, lambda, largest, progress } = &*self;
        let h = progress.h;
        let start = std::array::from_fn(|i| if i < N { d[i] } else { lambda[i - N] });
        let (_, g) = jacobian(x, |v| system.constraints(v));
        let extents = scale::constraints(&g, x, |i| d[i] * h);
        let scale =
            std::array::from_fn(|i| if i < N { largest.momentum(i) } else { extents[i - N] });
        let root = solve(start, &scale, |unknowns: &[D; U]| {
            let d: [D; N] = std::array::from_fn(|i| unknowns[i]);
            let lambda: [D; C] = std::array::from_fn(|c| unknowns[N + c]);
            let middle: [D; N] = std::array::from_fn(|i| x[i] + d[i] * (0.5 * h));
            let y: [D; N] = std::array::from_fn(|i| x[i] + d[i] * h);
            let mut step = system.momenta(x, &d, h);
            let (_, g) = jacobian(&middle, |v| system.constraints(v));
            let (values, g_end) = jacobian(&y, |v| system.constraints(v));
            let (push, bend) = hessian(&middle, |v| {
                let nothing = HyperDual::from_re(D::from(0.0));
                augmented(nothing, &lambda, system.constraints(v))
            });
            for i in 0..N {
                step.begin[i] -= push[i] * (0.5 * h);
                step.end[i] += push[i] * (0.5 * h);
                for j in 0..N {
                    step.stiffness[i][j] -= bend[i][j] * (0.25 * h * h);
                }
            }
            let residual = std::array::from_fn(|i| match i.checked_sub(N) {
                Some(c) => values[c],
                None => step.begin[i] - p[i],
            });
            let jacobian = saddle(&step.stiffness, &g, -0.5 * h, &g_end, h);
            Evaluation { residual, jacobian, known: (y, step.end) }
        })
        .map_err(|failure| progress.error(failure))?;
        on_branch_of_short_steps(&root.at.jacobian).map_err(|failure| progress.error(failure))?;
        self.d = std::array::from_fn(|i| root.x[i]);
        self.lambda = std::array::from_fn(|c| root.x[N + c]);
        let (y, end) = root.at.known;
        self.largest.update(|i| root.at.jacobian[i][i], [&self.p, &end], &self.d);
        (self.x, self.p) = (y, end);
        self.progress.solved(&root);
        self.progress.advance();
        Ok(())
    }

    fn configuration(&self) -> &[D; N] {
        &self.x
    }

    fn velocity(&self) -> Result<[D; N], StepError> {
        let Self { system, x, d, p, progress, .. } = self;
        Variational::<_, N, C, U, D>::from_momentum(system.clone(), progress.h, *x, *p, *d)
            .velocity()
    }

    fn progress(&self) -> &Progress {
        &self.progress
    }
}

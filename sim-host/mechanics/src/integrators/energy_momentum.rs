//! The energy-momentum method of §2.4.2, for any natural system, by Gonzalez' discrete gradient
//! (*Time integration and discrete Hamiltonian systems*, 1996). Energy is conserved for all; angular
//! momentum where the potential and the constraints are polynomials of degree two at most.
//!
//! # Notation
//! - `x, y` = `q^n, q^{n+1}`; `d = (y − x)/h`; `m = (x + y)/2`; unknowns `(d, λ)`
//! - `D̄f = Df(m) + e d/(h d·d)`, `e = f(y) − f(x) − h Df(m) d` (1)
//!
//! ```text
//! M d + h/2 (D̄ᵀV − F(m, d) − D̄ᵀg λ) = p,   D̄g d = 0                    (2)
//! p := 2 M d − p
//! ```
//! The second says that `g(y) = g(x)`, without the round-off of either, which the first would turn into
//! energy. With `p^{n+½} = M d` (2) is the printed set; its multipliers are of the other sign, and halved.

use super::branch::on_branch_of_short_steps;
use super::scale::{self, Largest};
use super::{Integrator, Progress, StepError};
use crate::newton::{Evaluation, solve};
use crate::{DiscreteLagrangian, Midpoint, Natural, Scalar, augmented, hessian, jacobian, saddle};
use num_dual::Dual;

/// A motion under the energy-momentum method.
#[derive(Clone, Debug)]
pub struct EnergyMomentum<S, const N: usize, const C: usize, const U: usize, D = f64> {
    system: S,
    x: [D; N],
    p: [D; N],
    lambda: [D; C],
    largest: Largest<N>,
    progress: Progress,
}

impl<S, D: Scalar, const N: usize, const C: usize, const U: usize> EnergyMomentum<S, N, C, U, D>
where
    S: Natural<N, C> + Clone,
{
    /// From a configuration on the manifold, and a velocity along it.
    pub fn new(system: S, h: f64, x: [D; N], v_dot: &[D; N]) -> Self {
        let masses = system.masses();
        let p = std::array::from_fn(|i| v_dot[i] * masses[i]);
        // The step's momenta are those of the midpoint rule.
        let largest = Largest::new(&Midpoint(system.clone()).momenta(&x, v_dot, h), v_dot);
        let lambda = [D::from(0.0); C];
        Self { system, x, p, lambda, largest, progress: Progress::new(h) }
    }

    fn rates(&self) -> [D; N] {
        let masses = self.system.masses();
        std::array::from_fn(|i| self.p[i] / masses[i])
    }
}

impl<S, D: Scalar, const N: usize, const C: usize, const U: usize> Integrator<N, D>
    for EnergyMomentum<S, N, C, U, D>
where
    S: Natural<N, C> + Clone,
{
    fn step(&mut self) -> Result<(), StepError> {
        let Self { system, x, p, lambda, largest, progress } = &*self;
        let h = progress.h;
        let masses = system.masses();
        let rates = self.rates();
        let start = std::array::from_fn(|i| if i < N { rates[i] } else { lambda[i - N] });
        let (_, g_begin) = jacobian(x, |q| system.constraints(q));
        let scale = std::array::from_fn(|i| match i.checked_sub(N) {
            Some(c) => largest.rate(&g_begin[c]),
            None => largest.momentum(i),
        });
        let extents = scale::constraints(&g_begin, x, |i| rates[i] * h);
        let (potential, constraints) = (system.potential(x), system.constraints(x));
        let root = solve(start, &scale, |unknowns: &[D; U]| {
            let d: [D; N] = std::array::from_fn(|i| unknowns[i]);
            let lambda: [D; C] = std::array::from_fn(|c| -unknowns[N + c]);
            let middle: [D; N] = std::array::from_fn(|i| x[i] + d[i] * (0.5 * h));
            let y: [D; N] = std::array::from_fn(|i| x[i] + d[i] * h);
            let (values, g_end) = jacobian(&y, |q| system.constraints(q));
            let (_, mut g) = jacobian(&middle, |q| system.constraints(q));
            let mut change = [D::from(0.0); C];
            for c in 0..C {
                let gap = Gap::new(&g[c], &d, h, [constraints[c], values[c]], extents[c]);
                g[c] = gap.gradient(&g[c], &d);
                change[c] = (0..N).map(|i| g[c][i] * d[i]).sum();
            }
            // The same of V − λᵀ g, with its derivative.
            let ([end], [slope_end]) =
                jacobian(&y, |q| [augmented(system.potential(q), &lambda, system.constraints(q))]);
            let (slope, bend) = hessian(&middle, |q| {
                augmented(system.potential(q), &lambda, system.constraints(q))
            });
            let begin = (0..C).fold(potential, |sum, c| sum + constraints[c] * lambda[c]);
            let terms =
                (0..C).fold(potential.re().abs(), |sum, c| sum + extents[c] * lambda[c].re().abs());
            let gap = Gap::new(&slope, &d, h, [begin, end], terms);
            let pull = gap.gradient(&slope, &d);
            let mut stiffness = gap.stiffness(&slope, &slope_end, &bend, &d, h);
            let mut external = [D::from(0.0); N];
            if let Some(force) = system.force(&middle, &d) {
                external = force;
                let (_, change) = jacobian(&d, |d| {
                    let middle = std::array::from_fn(|i| Dual::from_re(x[i]) + d[i] * (0.5 * h));
                    system.force(&middle, d).unwrap_or([Dual::from_re(D::from(0.0)); N])
                });
                for (row, change) in stiffness.iter_mut().zip(change) {
                    for (entry, change) in row.iter_mut().zip(change) {
                        *entry -= change;
                    }
                }
            }
            for i in 0..N {
                stiffness[i] = stiffness[i].map(|x| x * (0.5 * h));
                stiffness[i][i] += masses[i];
            }
            let residual = std::array::from_fn(|i| match i.checked_sub(N) {
                Some(c) => change[c],
                None => d[i] * masses[i] - p[i] + (pull[i] - external[i]) * (0.5 * h),
            });
            let jacobian = saddle(&stiffness, &g, -0.5 * h, &g_end, 1.0);
            Evaluation { residual, jacobian, known: y }
        })
        .map_err(|failure| progress.error(failure))?;
        on_branch_of_short_steps(&root.at.jacobian).map_err(|failure| progress.error(failure))?;
        let p = std::array::from_fn(|i| root.x[i] * (2.0 * masses[i]) - self.p[i]);
        self.largest.update(|i| root.at.jacobian[i][i], [&self.p, &p], &root.x[..N]);
        (self.x, self.p) = (root.at.known, p);
        self.lambda = std::array::from_fn(|c| root.x[N + c]);
        self.progress.solved(&root);
        self.progress.advance();
        Ok(())
    }

    fn configuration(&self) -> &[D; N] {
        &self.x
    }

    fn velocity(&self) -> Result<[D; N], StepError> {
        Ok(self.rates())
    }

    fn progress(&self) -> &Progress {
        &self.progress
    }
}

/// What (1) adds to the gradient at the midpoint; nothing for polynomials of degree two.
struct Gap<D> {
    /// `e/(h d·d)`
    share: D,
    /// `d·d`
    square: D,
}

impl<D: Scalar> Gap<D> {
    /// From the gradient at the midpoint and the values at both ends, whose terms are of a known size.
    fn new<const N: usize>(
        slope: &[D; N],
        d: &[D; N],
        h: f64,
        [begin, end]: [D; 2],
        terms: f64,
    ) -> Self {
        let square: D = d.iter().map(|d| *d * *d).sum();
        let work: D = slope.iter().zip(d).map(|(f, d)| *f * *d * h).sum();
        let e = end - begin - work;
        // Round-off of e, which must not be divided by a step that stands still.
        let is_round_off = e.re().abs() <= 16.0 * f64::EPSILON * terms;
        let share = if is_round_off { D::from(0.0) } else { e / (square * h) };
        Self { share, square }
    }

    /// (1)
    fn gradient<const N: usize>(&self, slope: &[D; N], d: &[D; N]) -> [D; N] {
        std::array::from_fn(|i| slope[i] + d[i] * self.share)
    }

    /// Derivative of (1) with respect to `d`.
    fn stiffness<const N: usize>(
        &self,
        slope: &[D; N],
        slope_end: &[D; N],
        bend: &[[D; N]; N],
        d: &[D; N],
        h: f64,
    ) -> [[D; N]; N] {
        let mut stiffness = bend.map(|row| row.map(|x| x * (0.5 * h)));
        if self.share.re() != 0.0 {
            for j in 0..N {
                let carried: D = (0..N).map(|k| bend[j][k] * d[k]).sum();
                // ∂e/∂d over h, and that of 1/(d·d).
                let e = slope_end[j] - slope[j] - carried * (0.5 * h);
                let change = e / self.square - self.share * d[j] * 2.0 / self.square;
                for i in 0..N {
                    stiffness[i][j] += d[i] * change;
                }
                stiffness[j][j] += self.share;
            }
        }
        stiffness
    }
}

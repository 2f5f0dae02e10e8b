//! The adaptive Runge–Kutta method of eighth order of Dormand and Prince (Hairer, Nørsett and Wanner's
//! DOP853), by the crate `differential-equations`: between the ends of a step it takes the steps that
//! its tolerance needs. Constraints drift, as far as that tolerance lets them.

use super::{Integrator, Progress, StepError, StepFailure};
use crate::newton::NewtonFailure;
use crate::{Lagrangian, acceleration};
use differential_equations::prelude::{ExplicitRungeKutta, IVP};
use std::cell::Cell;

/// A motion under the adaptive method.
#[derive(Clone, Debug)]
pub struct DormandPrince<S, const N: usize, const C: usize, const U: usize> {
    system: S,
    tolerance: f64,
    x: [f64; N],
    v: [f64; N],
    progress: Progress,
}

impl<S: Lagrangian<N, C>, const N: usize, const C: usize, const U: usize>
    DormandPrince<S, N, C, U>
{
    /// From a configuration on the manifold, and a velocity along it, with a tolerance relative to
    /// each unknown and to 1.
    pub fn new(system: S, tolerance: f64, h: f64, x: [f64; N], v_dot: [f64; N]) -> Self {
        let progress = Progress::new(h);
        Self { system, tolerance, x, v: v_dot, progress }
    }

    /// Evaluations of the differential equations so far.
    pub fn evaluations(&self) -> u64 {
        self.progress.evaluations
    }
}

/// Evaluations' bound within a step, in adaptive steps.
const MOST_ADAPTIVE_STEPS: usize = 100_000;

impl<S: Lagrangian<N, C>, const N: usize, const C: usize, const U: usize> Integrator<N>
    for DormandPrince<S, N, C, U>
{
    fn step(&mut self) -> Result<(), StepError> {
        let Self { system, tolerance, x, v, progress, .. } = &*self;
        let failed: Cell<Option<NewtonFailure>> = Cell::new(None);
        let rates = |_: f64, y: &Vec<f64>, rates: &mut Vec<f64>| {
            let x = std::array::from_fn(|i| y[i]);
            let v: [f64; N] = std::array::from_fn(|i| y[N + i]);
            let a = acceleration::<_, f64, N, C, U>(system, &x, &v).unwrap_or_else(|failure| {
                failed.set(Some(failure));
                [f64::NAN; N]
            });
            rates[..N].copy_from_slice(&v);
            rates[N..].copy_from_slice(&a);
        };
        let start: Vec<f64> = x.iter().chain(v).copied().collect();
        let method = ExplicitRungeKutta::dop853()
            .rtol(*tolerance)
            .atol(*tolerance)
            .max_steps(MOST_ADAPTIVE_STEPS);
        let solution = IVP::ode_from_fn(rates, 0.0, progress.h, start).method(method).solve();
        let lost = || progress.error(failed.get().map_or(StepFailure::Adaptive, Into::into));
        let solution = solution.map_err(|_| lost())?;
        let Some((_, end)) = solution.last().ok().filter(|(_, y)| y.iter().all(|y| y.is_finite()))
        else {
            return Err(lost());
        };
        (self.x, self.v) = (std::array::from_fn(|i| end[i]), std::array::from_fn(|i| end[N + i]));
        self.progress.evaluated(solution.evals.function as u64);
        self.progress.advance();
        Ok(())
    }

    fn configuration(&self) -> &[f64; N] {
        &self.x
    }

    fn velocity(&self) -> Result<[f64; N], StepError> {
        Ok(self.v)
    }

    fn progress(&self) -> &Progress {
        &self.progress
    }
}

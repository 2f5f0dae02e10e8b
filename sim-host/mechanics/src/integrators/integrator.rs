//! What every method is: something that makes steps.

use super::{StepError, StepFailure};
use crate::Scalar;
use crate::newton::Root;
use serde::{Deserialize, Serialize};

/// A motion under one method. In numbers that carry derivatives it carries those of its start along:
/// the method's tangent map, exactly.
pub trait Integrator<const N: usize, D: Scalar = f64> {
    /// One step.
    ///
    /// # Errors
    /// A [`StepError`]; the motion is then where it was.
    fn step(&mut self) -> Result<(), StepError>;

    /// The configuration.
    fn configuration(&self) -> &[D; N];

    /// The velocity there, of the method's order, along the manifold for methods that know one.
    ///
    /// # Errors
    /// For methods that keep a momentum, where it belongs to no velocity.
    fn velocity(&self) -> Result<[D; N], StepError>;

    /// Time and statistics.
    fn progress(&self) -> &Progress;
}

/// How far a motion is, and what it took.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Progress {
    /// Step, s.
    pub h: f64,
    /// Time, s.
    pub time_s: f64,
    /// Steps made.
    pub steps: u64,
    /// Newton iterations in all.
    pub iterations: u64,
    /// Newton iterations of the step that took most, those of all its stages or parts.
    pub most_iterations: u32,
    /// Newton iterations since the last step was made.
    #[serde(skip)]
    iterations_of_step: u32,
    /// Evaluations of residuals, or of the differential equations for methods on those.
    #[serde(default)]
    pub evaluations: u64,
    /// Largest residual left, relative to its terms.
    pub residual: f64,
    /// Steps that had to be made in shorter ones.
    pub split_steps: u64,
}

impl Progress {
    /// At the start.
    pub fn new(h: f64) -> Self {
        Self {
            h,
            time_s: 0.0,
            steps: 0,
            iterations: 0,
            most_iterations: 0,
            iterations_of_step: 0,
            evaluations: 0,
            residual: 0.0,
            split_steps: 0,
        }
    }

    /// Newton iterations a step, on average.
    pub fn mean_iterations(&self) -> f64 {
        self.iterations as f64 / self.steps.max(1) as f64
    }

    /// The error of a step that could not be made from here.
    pub fn error(&self, failure: impl Into<StepFailure>) -> StepError {
        StepError { step: self.steps, h: self.h, time_s: self.time_s, failure: failure.into() }
    }

    /// A step has been made.
    pub fn advance(&mut self) {
        self.steps += 1;
        self.most_iterations = self.most_iterations.max(self.iterations_of_step);
        self.iterations_of_step = 0;
        // Not by addition, whose round-off would add up.
        self.time_s = self.steps as f64 * self.h;
    }

    /// A step's equations have been solved, or a part of them.
    pub(super) fn solved<T, const U: usize, D>(&mut self, root: &Root<T, U, D>) {
        self.evaluated(u64::from(root.evaluations));
        self.iterated(root.iterations, root.residual);
    }

    /// Equations have been evaluated so many times.
    pub fn evaluated(&mut self, times: u64) {
        self.evaluations += times;
    }

    /// The same by a solver of one's own, without its evaluations.
    pub fn iterated(&mut self, iterations: u32, residual: f64) {
        self.iterations += u64::from(iterations);
        self.iterations_of_step += iterations;
        self.residual = self.residual.max(residual);
    }
}

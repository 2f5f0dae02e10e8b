//! Symmetric compositions of a symmetric second-order method (Yoshida 1990): the same method with
//! steps of other lengths, some backwards, that cancel its errors up to a higher order. What each step
//! conserves, the whole conserves.

use super::{Integrator, Progress, StepError, Variational};
use crate::{DiscreteLagrangian, Scalar};

/// Fourth order, three stages: `1/(2 − 2^{1/3})` twice about `−2^{1/3}/(2 − 2^{1/3})`.
pub const YOSHIDA_4: [f64; 3] =
    [1.351_207_191_959_657_8, -1.702_414_383_919_315_6, 1.351_207_191_959_657_8];

/// The longest stage of a composition, over its step.
pub fn longest_stage(stages: &[f64]) -> f64 {
    stages.iter().fold(0.0, |longest: f64, stage| longest.max(stage.abs()))
}

/// Sixth order, seven stages: solution A of Yoshida's table 1.
pub const YOSHIDA_6: [f64; 7] = [
    0.784_513_610_477_560,
    0.235_573_213_359_357,
    -1.177_679_984_178_87,
    1.315_186_320_683_906,
    -1.177_679_984_178_87,
    0.235_573_213_359_357,
    0.784_513_610_477_560,
];

/// A motion in composed steps. The method inside must be symmetric: [`crate::Midpoint`] is.
#[derive(Clone, Debug)]
pub struct Composition<S, const N: usize, const C: usize, const U: usize, D = f64> {
    inner: Variational<S, N, C, U, D>,
    stages: &'static [f64],
}

impl<S, D: Scalar, const N: usize, const C: usize, const U: usize> Composition<S, N, C, U, D>
where
    S: DiscreteLagrangian<N, C>,
{
    /// From a configuration on the manifold and its velocity, with the shares of a step that the
    /// stages take.
    pub fn new(system: S, stages: &'static [f64], h: f64, x: [D; N], v_dot: [D; N]) -> Self {
        Self { inner: Variational::from_velocity(system, h, x, v_dot), stages }
    }
}

impl<S, D: Scalar, const N: usize, const C: usize, const U: usize> Integrator<N, D>
    for Composition<S, N, C, U, D>
where
    S: DiscreteLagrangian<N, C> + Clone,
{
    fn step(&mut self) -> Result<(), StepError> {
        let mut inner = self.inner.clone();
        for share in self.stages {
            inner.step_by(share * inner.progress.h)?;
        }
        inner.progress.advance();
        self.inner = inner;
        Ok(())
    }

    fn configuration(&self) -> &[D; N] {
        self.inner.configuration()
    }

    fn velocity(&self) -> Result<[D; N], StepError> {
        self.inner.velocity()
    }

    fn progress(&self) -> &Progress {
        &self.inner.progress
    }
}

//! Symmetric compositions of a symmetric second-order method (Yoshida 1990): the same method with
//! steps of other lengths, some backwards, that cancel its errors up to a higher order. What each step
//! conserves, the whole conserves.

use super::{StepError, Variational};
use crate::mechanics::DiscreteLagrangian;

/// Fourth order, three stages: `1/(2 − 2^{1/3})` twice about `−2^{1/3}/(2 − 2^{1/3})`.
pub const YOSHIDA_4: [f64; 3] =
    [1.351_207_191_959_657_8, -1.702_414_383_919_315_6, 1.351_207_191_959_657_8];

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

/// A motion in composed steps. The method inside must be symmetric: [`crate::mechanics::Midpoint`] is.
#[derive(Clone, Debug)]
pub struct Composition<S, const N: usize, const C: usize, const U: usize> {
    inner: Variational<S, N, C, U>,
    stages: &'static [f64],
    h: f64,
}

impl<S: DiscreteLagrangian<N, C>, const N: usize, const C: usize, const U: usize>
    Composition<S, N, C, U>
{
    /// From a configuration on the manifold and its velocity, with the shares of a step that the
    /// stages take.
    pub fn new(system: S, stages: &'static [f64], h: f64, x: [f64; N], v_dot: [f64; N]) -> Self {
        Self { inner: Variational::from_velocity(system, h, x, v_dot), stages, h }
    }

    /// The configuration.
    pub fn configuration(&self) -> &[f64; N] {
        self.inner.configuration()
    }

    /// The momentum there.
    pub fn momentum(&self) -> &[f64; N] {
        self.inner.momentum()
    }

    /// One step of all stages.
    ///
    /// # Errors
    /// That of the stage that failed.
    pub fn step(&mut self) -> Result<(), StepError> {
        self.stages.iter().try_for_each(|share| self.inner.step_by(share * self.h).map(|_| ()))
    }
}

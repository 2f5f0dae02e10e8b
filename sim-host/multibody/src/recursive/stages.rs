//! Steps composed of others, forwards and backwards.

use super::simulation::Simulation;
use crate::stepping::make_stages;
use surefoot_mechanics::integrators::StepError;

impl Simulation {
    /// One step in stages, each this share of it. A step is symmetric in time as long as nothing touches
    /// anything, so that the shares of [`surefoot_mechanics::integrators::YOSHIDA_4`] make a method of fourth order.
    ///
    /// # Errors
    /// A [`StepError`]; the motion is then where it was. Stages are not made in shorter ones.
    ///
    /// # Cost
    /// A step for each stage.
    pub fn step_in_stages(&mut self, stages: &[f64]) -> Result<(), StepError> {
        make_stages(self, stages)
    }
}

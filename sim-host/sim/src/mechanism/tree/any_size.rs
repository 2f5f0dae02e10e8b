//! Bodies and joints of any number, with loops, springs between points and rolling.

use super::equations::{Rates, TreeModel};
use surefoot::dynamics::DynamicsFault;
use surefoot_mechanics::integrators::StepFailure;
use surefoot_multibody::{BodyState, JointSpace, SettleFault};

impl TreeModel for JointSpace {
    fn start(&self) -> (Vec<f64>, Vec<f64>) {
        let (positions, velocities) = Self::start(self);
        (positions.to_vec(), velocities.to_vec())
    }

    fn rates(
        &self,
        positions: &[f64],
        velocities: &[f64],
        rates: Rates<'_>,
    ) -> Result<(), DynamicsFault> {
        Self::position_rates(self, positions, velocities, rates.positions);
        rates.velocities.copy_from_slice(&self.accelerations(positions, velocities)?);
        Ok(())
    }

    fn position_rates(&self, positions: &[f64], velocities: &[f64]) -> Vec<f64> {
        let mut rates = vec![0.0; positions.len()];
        Self::position_rates(self, positions, velocities, &mut rates);
        rates
    }

    fn bodies(
        &self,
        positions: &[f64],
        velocities: &[f64],
    ) -> Result<(Vec<BodyState>, Vec<BodyState>), DynamicsFault> {
        Ok(Self::bodies(self, positions, velocities))
    }

    fn angle(&self, link: usize, positions: &[f64]) -> f64 {
        Self::angle(self, link, positions)
    }

    fn settle(&mut self, positions: &mut [f64], velocities: &mut [f64]) -> Result<(), StepFailure> {
        Self::settle(self, positions, velocities).map_err(|fault| match fault {
            SettleFault::Newton(failure) => failure.into(),
            SettleFault::Dynamics(fault) => fault.into(),
        })
    }
}

//! Motions in a plane, and of one free body, as those of any other mechanism.

use super::moving::{Moving, conserved, dissipates_nothing, is_free, kinetic};
use crate::record::SavedMotion;
use surefoot_mechanics::integrators::{Progress, StepError};
use surefoot_multibody::contact::ContactPoint;
use surefoot_multibody::{
    BodyState, PlanarSimulation, Simulation, SingleBody, System, SystemError,
};

/// Told by the simulator in space, where the motion is now. A singular inertia is the step's to report.
fn forecast_s(
    system: &System,
    h: f64,
    (states, rates): (&[BodyState], &[BodyState]),
) -> Option<f64> {
    Simulation::new(system.clone(), h, states, rates).ok()?.forecast().ok()?.step_s()
}

impl Moving for PlanarSimulation {
    fn step(&mut self) -> Result<(), StepError> {
        Self::step(self)
    }

    fn state(&mut self) -> Result<(Vec<f64>, Vec<f64>), StepError> {
        Ok((self.states().concat(), self.rates()?.concat()))
    }

    fn conserved(&mut self) -> Result<(f64, Vec<f64>, f64), StepError> {
        let energies = self.energies()?;
        let rates = if is_free(self.system()) { self.rates()? } else { Vec::new() };
        Ok(conserved(self.system(), energies, &self.states(), &rates))
    }

    fn kinetic(&self, configuration: &[f64], velocity: &[f64]) -> f64 {
        kinetic(self.system(), configuration, velocity)
    }

    fn keeps_energy(&self) -> bool {
        dissipates_nothing(self.system()) && !self.is_driven()
    }

    fn in_steps_of(&self, h: f64) -> Option<Box<dyn Moving>> {
        Some(Box::new(Self::in_steps_of(self, h)))
    }

    fn progress(&self) -> &Progress {
        Self::progress(self)
    }

    fn forecast_s(&mut self) -> Option<f64> {
        let (states, rates) = (self.states(), self.rates().ok()?);
        forecast_s(self.system(), Self::progress(self).h, (&states, &rates))
    }

    fn unknowns(&self) -> usize {
        Self::unknowns(self)
    }

    fn contacts(&self) -> &[ContactPoint] {
        Self::contacts(self)
    }

    fn contact_forces(&self) -> Vec<[f64; 3]> {
        Self::contact_forces(self)
    }

    fn checkpoint(&self) -> Option<SavedMotion> {
        Some(SavedMotion::Planar(Self::checkpoint(self).clone()))
    }

    fn restore(&mut self, from: &SavedMotion) -> Result<(), SystemError> {
        match from {
            SavedMotion::Planar(checkpoint) => Self::restore(self, checkpoint),
            _ => Err(SystemError::OtherCheckpoint),
        }
    }
}

impl Moving for SingleBody {
    fn step(&mut self) -> Result<(), StepError> {
        Self::step(self)
    }

    fn state(&mut self) -> Result<(Vec<f64>, Vec<f64>), StepError> {
        Ok((Self::state(self).to_vec(), self.rate().to_vec()))
    }

    fn conserved(&mut self) -> Result<(f64, Vec<f64>, f64), StepError> {
        Ok(conserved(self.system(), self.energies(), &[Self::state(self)], &[self.rate()]))
    }

    fn kinetic(&self, configuration: &[f64], velocity: &[f64]) -> f64 {
        kinetic(self.system(), configuration, velocity)
    }

    fn keeps_energy(&self) -> bool {
        dissipates_nothing(self.system())
    }

    fn in_steps_of(&self, h: f64) -> Option<Box<dyn Moving>> {
        Some(Box::new(Self::in_steps_of(self, h)))
    }

    fn progress(&self) -> &Progress {
        Self::progress(self)
    }

    fn forecast_s(&mut self) -> Option<f64> {
        let (state, rate) = (Self::state(self), self.rate());
        forecast_s(self.system(), Self::progress(self).h, (&[state], &[rate]))
    }

    fn unknowns(&self) -> usize {
        Self::unknowns(self)
    }

    fn contacts(&self) -> &[ContactPoint] {
        Self::contacts(self)
    }

    fn contact_forces(&self) -> Vec<[f64; 3]> {
        Self::contact_forces(self).to_vec()
    }

    fn checkpoint(&self) -> Option<SavedMotion> {
        Some(SavedMotion::Body(Self::checkpoint(self).clone()))
    }

    fn restore(&mut self, from: &SavedMotion) -> Result<(), SystemError> {
        match from {
            SavedMotion::Body(checkpoint) => Self::restore(self, checkpoint),
            _ => Err(SystemError::OtherCheckpoint),
        }
    }
}

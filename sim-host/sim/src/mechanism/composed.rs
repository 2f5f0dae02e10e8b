//! Bodies and joints in steps that are composed of the simulator's own.

use super::moving::Moving;
use surefoot_mechanics::integrators::{
    Method, Progress, StartError, StepError, YOSHIDA_4, YOSHIDA_6, longest_stage,
};
use surefoot_multibody::Simulation;

/// A motion in composed steps.
pub(super) struct Composed {
    simulation: Simulation,
    /// Shares of a step.
    stages: &'static [f64],
}

impl Composed {
    /// From a motion that has not begun.
    ///
    /// # Errors
    /// [`StartError::NotFor`] where something can be touched: a step backwards through a contact is none. Or where
    /// the method is no composition.
    pub fn new(method: Method, simulation: Simulation) -> Result<Self, StartError> {
        let not_for = |takes| StartError::NotFor { method, takes };
        let system = simulation.system();
        if system.ground().is_some() || !system.strikers().is_empty() {
            return Err(not_for("bodies that touch nothing, as it steps backwards too,"));
        }
        let stages: &[f64] = match method {
            Method::Yoshida4 => &YOSHIDA_4,
            Method::Yoshida6 => &YOSHIDA_6,
            _ => return Err(not_for("the mechanisms of chapter 2")),
        };
        Ok(Self { simulation, stages })
    }
}

impl Moving for Composed {
    fn step(&mut self) -> Result<(), StepError> {
        self.simulation.step_in_stages(self.stages)
    }

    fn state(&mut self) -> Result<(Vec<f64>, Vec<f64>), StepError> {
        Moving::state(&mut self.simulation)
    }

    fn conserved(&mut self) -> Result<(f64, Vec<f64>, f64), StepError> {
        self.simulation.conserved()
    }

    fn kinetic(&self, configuration: &[f64], velocity: &[f64]) -> f64 {
        Moving::kinetic(&self.simulation, configuration, velocity)
    }

    fn keeps_energy(&self) -> bool {
        self.simulation.keeps_energy()
    }

    fn in_steps_of(&self, h: f64) -> Option<Box<dyn Moving>> {
        let simulation = Simulation::in_steps_of(&self.simulation, h);
        Some(Box::new(Self { simulation, stages: self.stages }))
    }

    fn progress(&self) -> &Progress {
        self.simulation.progress()
    }

    /// Each stage is a step of the simulator's.
    fn forecast_s(&mut self) -> Option<f64> {
        Some(self.simulation.forecast_s()? / longest_stage(self.stages))
    }

    fn unknowns(&self) -> usize {
        self.simulation.unknowns()
    }
}

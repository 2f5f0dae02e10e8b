//! A mechanism on its way, whatever its size.

use crate::record::SavedMotion;
use num_dual::Dual64;
use std::cell::LazyCell;
use surefoot_mechanics::Lagrangian;
use surefoot_mechanics::integrators::{Motion, Progress, StepError};
use surefoot_multibody::contact::ContactPoint;
use surefoot_multibody::{BodyState, Simulation, System, SystemError};

/// A mechanism on its way.
pub trait Moving {
    /// One step.
    ///
    /// # Errors
    /// A [`StepError`]; the motion is then where it was.
    fn step(&mut self) -> Result<(), StepError>;

    /// Configuration and velocity.
    ///
    /// # Errors
    /// Where the method's momentum belongs to no velocity.
    fn state(&mut self) -> Result<(Vec<f64>, Vec<f64>), StepError>;

    /// Energy, J; angular momentum as far as it is conserved, N·m·s; largest constraint.
    ///
    /// # Errors
    /// As for [`Self::state`].
    fn conserved(&mut self) -> Result<(f64, Vec<f64>, f64), StepError>;

    /// Kinetic energy with this configuration and velocity, J.
    fn kinetic(&self, configuration: &[f64], velocity: &[f64]) -> f64;

    /// Whether nothing takes or gives energy: no damper, no motor, no floor.
    fn keeps_energy(&self) -> bool;

    /// Time and statistics.
    fn progress(&self) -> &Progress;

    /// The longest step foretold for its method, s: for the whole motion, or for as it is now.
    fn forecast_s(&mut self) -> Option<f64>;

    /// Coordinates and constraints.
    fn unknowns(&self) -> usize;

    /// Points that can touch the floor.
    fn contacts(&self) -> &[ContactPoint] {
        &[]
    }

    /// Mean forces of the floor on these points in the last step, N, world frame.
    fn contact_forces(&self) -> Vec<[f64; 3]> {
        Vec::new()
    }

    /// The same motion from here on, in steps of another length, as of time zero; none of a motion that can only be
    /// started anew.
    fn in_steps_of(&self, _h: f64) -> Option<Box<dyn Moving>> {
        None
    }

    /// All that is needed to go on from here, for motions that can be taken up again.
    fn checkpoint(&self) -> Option<SavedMotion> {
        None
    }

    /// Goes on from where a motion was.
    ///
    /// # Errors
    /// Where it is another motion or model, or the motion cannot be taken up again.
    fn restore(&mut self, _: &SavedMotion) -> Result<(), SystemError> {
        Err(SystemError::OtherCheckpoint)
    }
}

/// A motion of `S`, with its angular momentum.
pub(super) struct Moved<S, const N: usize, const C: usize> {
    pub(super) system: S,
    pub(super) motion: Motion<N>,
    pub(super) momentum: fn(&S, &[f64; N], &[f64; N]) -> Vec<f64>,
    pub(super) forecast_s: Forecast,
}

/// Asked for by few, and made from a motion of its own.
pub(super) type Forecast = LazyCell<Option<f64>, Box<dyn FnOnce() -> Option<f64>>>;

impl<S: Lagrangian<N, C>, const N: usize, const C: usize> Moving for Moved<S, N, C> {
    fn step(&mut self) -> Result<(), StepError> {
        self.motion.step()
    }

    fn state(&mut self) -> Result<(Vec<f64>, Vec<f64>), StepError> {
        Ok((self.motion.configuration().to_vec(), self.motion.velocity()?.to_vec()))
    }

    fn conserved(&mut self) -> Result<(f64, Vec<f64>, f64), StepError> {
        let (x, v) = (self.motion.configuration(), self.motion.velocity()?);
        let constraints: [Dual64; C] = self.system.constraints(&x.map(Dual64::from_re));
        let largest = constraints.iter().fold(0.0, |m: f64, g| m.max(g.re.abs()));
        Ok((self.system.energy(x, &v), (self.momentum)(&self.system, x, &v), largest))
    }

    fn kinetic(&self, configuration: &[f64], velocity: &[f64]) -> f64 {
        let [x, v] = [configuration, velocity].map(|all| std::array::from_fn(|i| all[i]));
        0.5 * (self.system.energy(&x, &v) + self.system.lagrangian(&x, &v))
    }

    fn keeps_energy(&self) -> bool {
        let x = self.motion.configuration();
        self.system.force(x, &[0.0; N]).is_none()
    }

    fn progress(&self) -> &Progress {
        self.motion.progress()
    }

    fn forecast_s(&mut self) -> Option<f64> {
        *self.forecast_s
    }

    fn unknowns(&self) -> usize {
        N + C
    }
}

/// Whether nothing holds the bodies from without: else nothing of their angular momentum is conserved that is not
/// the pivot's affair.
pub(super) fn is_free(system: &System) -> bool {
    system.gravity() == 0.0
        && system.ground().is_none()
        && system.closures().iter().all(|closure| closure.inboard.is_some())
        && system.links().iter().all(|l| l.inboard.is_some() || l.joint.constraints() == 0)
}

/// Kinetic energy of bodies in a row, J.
pub(super) fn kinetic(system: &System, configuration: &[f64], velocity: &[f64]) -> f64 {
    system.kinetic_energy(configuration.as_chunks().0, velocity.as_chunks().0)
}

/// Whether no floor, no striker and no damper takes energy.
pub(super) fn dissipates_nothing(system: &System) -> bool {
    system.ground().is_none()
        && system.strikers().is_empty()
        && system.laws().iter().all(|(_, law)| !law.dissipates())
}

/// What [`Moving::conserved`] tells of bodies; their rates are asked for where these are free.
pub(super) fn conserved(
    system: &System,
    (kinetic, potential): (f64, f64),
    states: &[BodyState],
    rates: &[BodyState],
) -> (f64, Vec<f64>, f64) {
    let momentum =
        if is_free(system) { system.momentum(states, rates).1.to_vec() } else { Vec::new() };
    (kinetic + potential, momentum, system.largest_constraint(states))
}

impl Moving for Simulation {
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
        // A singular inertia is the step's to report.
        self.forecast().ok()?.step_s()
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
        Some(SavedMotion::Tree(Self::checkpoint(self).clone()))
    }

    fn restore(&mut self, from: &SavedMotion) -> Result<(), SystemError> {
        match from {
            SavedMotion::Tree(checkpoint) => Self::restore(self, checkpoint),
            _ => Err(SystemError::OtherCheckpoint),
        }
    }
}

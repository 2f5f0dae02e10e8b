//! A motion as it is measured, whatever makes its steps.

use crate::integrators::{Progress, StepError, StepFailure, YOSHIDA_4, YOSHIDA_6};
use crate::mechanism::Moving;
use crate::multibody::{BodyState, ConstrainedSimulation, Simulation, System};
use nalgebra::Vector3;
use surefoot::dynamics::DynamicsFault;
use surefoot::spatial::Quaternion;

/// Why a course has ended.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum Trouble {
    /// A step could not be made.
    #[error("{0}")]
    Step(#[from] StepError),
    /// The equations of motion have no solution.
    #[error("at {time_s} s: {fault}")]
    Dynamics {
        /// s
        time_s: f64,
        /// Why.
        fault: DynamicsFault,
    },
    /// The adaptive method cannot meet its tolerance.
    #[error("at {time_s} s: {}", StepFailure::Adaptive)]
    Adaptive {
        /// s
        time_s: f64,
    },
}

impl Trouble {
    /// When, s.
    pub fn time_s(&self) -> f64 {
        match self {
            Self::Step(error) => error.time_s,
            Self::Dynamics { time_s, .. } | Self::Adaptive { time_s } => *time_s,
        }
    }
}

/// What a motion should keep.
#[derive(Clone, Debug, PartialEq)]
pub struct Conserved {
    /// J
    pub energy: f64,
    /// As far as it is conserved.
    pub momentum: Vec<f64>,
    /// Largest constraint.
    pub constraint: f64,
}

/// A motion on its way.
pub trait Course {
    /// One step.
    ///
    /// # Errors
    /// A [`Trouble`].
    fn step(&mut self) -> Result<(), Trouble>;

    /// Where it is: coordinates that are the same for all methods. Of bodies their landmarks.
    ///
    /// # Errors
    /// A [`Trouble`] where that cannot be told.
    fn place(&mut self) -> Result<Vec<f64>, Trouble>;

    /// Energy, momentum and constraints.
    ///
    /// # Errors
    /// A [`Trouble`] where the method's momentum belongs to no velocity.
    fn conserved(&mut self) -> Result<Conserved, Trouble>;

    /// Time and statistics.
    fn progress(&self) -> &Progress;
}

/// Of each body three points, m: its centre of mass, and the ends of two of its axes, as long as its
/// radius of gyration. Quaternions of either sign give the same.
pub fn landmarks(system: &System, states: &[BodyState]) -> Vec<f64> {
    let mut all = Vec::with_capacity(9 * states.len());
    for (link, state) in system.links().iter().zip(states) {
        let [x, y, z, q @ ..] = *state;
        let [a, b, c] = link.body.inertia;
        let radius = (0.5 * (a + b + c) / link.body.mass).sqrt();
        let (centre, turn) = (Vector3::new(x, y, z), Quaternion::from_array(q));
        all.extend(centre.iter());
        for axis in [Vector3::x(), Vector3::y()] {
            all.extend((centre + turn.rotate(axis * radius)).iter());
        }
    }
    all
}

/// A mechanism of chapter 2, under any of its methods.
pub struct OfMechanism(pub Box<dyn Moving>);

impl Course for OfMechanism {
    fn step(&mut self) -> Result<(), Trouble> {
        Ok(self.0.step()?)
    }

    fn place(&mut self) -> Result<Vec<f64>, Trouble> {
        Ok(self.0.state()?.0)
    }

    fn conserved(&mut self) -> Result<Conserved, Trouble> {
        let (energy, momentum, constraint) = self.0.conserved()?;
        Ok(Conserved { energy, momentum, constraint })
    }

    fn progress(&self) -> &Progress {
        self.0.progress()
    }
}

/// How the simulator's steps are composed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stages {
    /// They are not; those that fail are made in shorter ones.
    One,
    /// To fourth order.
    Yoshida4,
    /// To sixth order.
    Yoshida6,
}

/// Bodies in the multibody simulator, in joint coordinates.
pub struct OfBodies {
    /// The motion.
    pub simulation: Simulation,
    /// How steps are composed.
    pub stages: Stages,
}

impl Course for OfBodies {
    fn step(&mut self) -> Result<(), Trouble> {
        Ok(match self.stages {
            Stages::One => self.simulation.step(),
            Stages::Yoshida4 => self.simulation.step_in_stages(&YOSHIDA_4),
            Stages::Yoshida6 => self.simulation.step_in_stages(&YOSHIDA_6),
        }?)
    }

    fn place(&mut self) -> Result<Vec<f64>, Trouble> {
        Ok(landmarks(self.simulation.system(), &self.simulation.states()))
    }

    fn conserved(&mut self) -> Result<Conserved, Trouble> {
        let (energy, momentum, constraint) = Moving::conserved(&mut self.simulation)?;
        Ok(Conserved { energy, momentum, constraint })
    }

    fn progress(&self) -> &Progress {
        self.simulation.progress()
    }
}

/// Bodies in the form with constraints, without contact.
pub struct OfConstrainedBodies {
    /// The motion.
    pub simulation: ConstrainedSimulation,
    /// Whether angular momentum is conserved.
    pub is_free: bool,
}

impl Course for OfConstrainedBodies {
    fn step(&mut self) -> Result<(), Trouble> {
        Ok(self.simulation.step()?)
    }

    fn place(&mut self) -> Result<Vec<f64>, Trouble> {
        Ok(landmarks(self.simulation.system(), self.simulation.states()))
    }

    fn conserved(&mut self) -> Result<Conserved, Trouble> {
        let (states, rates) = (self.simulation.states(), self.simulation.rates()?);
        Ok(conserved(self.simulation.system(), states, &rates, self.is_free))
    }

    fn progress(&self) -> &Progress {
        self.simulation.progress()
    }
}

/// What bodies in this state and with these rates should keep.
pub(super) fn conserved(
    system: &System,
    states: &[BodyState],
    rates: &[BodyState],
    is_free: bool,
) -> Conserved {
    Conserved {
        energy: system.energy(states, rates),
        momentum: if is_free { system.momentum(states, rates).1.to_vec() } else { Vec::new() },
        constraint: system.largest_constraint(states),
    }
}

//! A motion as it is measured, whatever makes its steps.

use nalgebra::Vector3;
use std::sync::Arc;
use surefoot::spatial::Quaternion;
use surefoot_mechanics::integrators::{Progress, StepError};
use surefoot_multibody::{BodyState, ConstrainedSimulation, System};
use surefoot_sim::mechanism::Moving;

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
    /// A [`StepError`].
    fn step(&mut self) -> Result<(), StepError>;

    /// Where it is: coordinates that are the same for all methods. Of bodies their landmarks.
    ///
    /// # Errors
    /// A [`StepError`] where that cannot be told.
    fn place(&mut self) -> Result<Vec<f64>, StepError>;

    /// Energy, momentum and constraints.
    ///
    /// # Errors
    /// A [`StepError`] where the method's momentum belongs to no velocity.
    fn conserved(&mut self) -> Result<Conserved, StepError>;

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
    fn step(&mut self) -> Result<(), StepError> {
        self.0.step()
    }

    fn place(&mut self) -> Result<Vec<f64>, StepError> {
        Ok(self.0.state()?.0)
    }

    fn conserved(&mut self) -> Result<Conserved, StepError> {
        let (energy, momentum, constraint) = self.0.conserved()?;
        Ok(Conserved { energy, momentum, constraint })
    }

    fn progress(&self) -> &Progress {
        self.0.progress()
    }
}

/// Bodies and joints, under any method: coordinates differ from method to method, landmarks do not.
pub struct OfBodies {
    /// The motion.
    pub moving: Box<dyn Moving>,
    /// What moves.
    pub system: Arc<System>,
}

impl Course for OfBodies {
    fn step(&mut self) -> Result<(), StepError> {
        self.moving.step()
    }

    fn place(&mut self) -> Result<Vec<f64>, StepError> {
        let (states, _) = self.moving.state()?;
        let (states, _) = states.as_chunks::<7>();
        Ok(landmarks(&self.system, states))
    }

    fn conserved(&mut self) -> Result<Conserved, StepError> {
        let (energy, momentum, constraint) = self.moving.conserved()?;
        Ok(Conserved { energy, momentum, constraint })
    }

    fn progress(&self) -> &Progress {
        self.moving.progress()
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
    fn step(&mut self) -> Result<(), StepError> {
        self.simulation.step()
    }

    fn place(&mut self) -> Result<Vec<f64>, StepError> {
        Ok(landmarks(self.simulation.system(), self.simulation.states()))
    }

    fn conserved(&mut self) -> Result<Conserved, StepError> {
        let (states, rates) = (self.simulation.states(), self.simulation.rates()?);
        let system = self.simulation.system();
        Ok(Conserved {
            // This form takes no springs in joints.
            energy: system.energy(states, &rates, |_| 0.0),
            momentum: match self.is_free {
                true => system.momentum(states, &rates).1.to_vec(),
                false => Vec::new(),
            },
            constraint: system.largest_constraint(states),
        })
    }

    fn progress(&self) -> &Progress {
        self.simulation.progress()
    }
}

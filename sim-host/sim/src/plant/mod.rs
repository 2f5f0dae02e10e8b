//! Plants: robots that move under torques.

mod configuration;
mod differences;
mod energies;
mod explicit_state;
mod joint_stops;
mod on_floor;
mod robot_model;
mod robot_system;
mod struck;
mod thrown_block;
mod variational;
mod welded;

pub use configuration::retract;
pub use differences::{BodyDifference, Differences, JointDifference};
pub use on_floor::OnFloor;
pub use robot_model::RobotModel;
pub use struck::Struck;
pub use thrown_block::{BlockSample, ThrownBlock};
pub use variational::{Additions, Variational};
pub use welded::Welded;

use surefoot::dynamics::DynamicsFault;
use surefoot::spatial::{Pose, Wrench};
use surefoot_mechanics::integrators::{Progress, StepError};
use surefoot_multibody::contact::ContactState;
use surefoot_multibody::{Checkpoint, SystemError};

/// State of a plant, of as many joints as its robot has.
#[derive(Debug, Default, PartialEq)]
pub struct PlantState {
    /// Position (m) and quaternion (scalar first) of the central body, joint angles (rad).
    pub positions: Vec<f64>,
    /// Body twist of the central body (m/s, rad/s), joint rates (rad/s).
    pub velocities: Vec<f64>,
}

impl PlantState {
    /// At rest at the origin, upright, with so many joints at 0.
    pub fn home(joints: usize) -> Self {
        let mut positions = vec![0.0; 7 + joints];
        positions[3] = 1.0;
        Self { positions, velocities: vec![0.0; 6 + joints] }
    }

    /// How many joints it has.
    pub fn joints(&self) -> usize {
        self.velocities.len().saturating_sub(6)
    }
}

impl Clone for PlantState {
    fn clone(&self) -> Self {
        Self { positions: self.positions.clone(), velocities: self.velocities.clone() }
    }

    /// Without an allocation where both have as many joints.
    fn clone_from(&mut self, source: &Self) {
        self.positions.clone_from(&source.positions);
        self.velocities.clone_from(&source.velocities);
    }
}

/// Something of each contact point, by foot.
pub type PerPoint<T> = Vec<Vec<T>>;

/// What a plant shows besides its state.
#[derive(Clone, Debug, PartialEq)]
pub struct Observation {
    /// Kinetic energy, J.
    pub kinetic_energy: f64,
    /// Potential energy of gravity, floor at 0, and of the floor's and stops' springs, J.
    pub potential_energy: f64,
    /// Vertical force of the ground on each foot, N.
    pub foot_forces: Vec<f64>,
    /// Contact states by foot and point, in the robot's order; `None` where the plant has no contact points.
    pub contacts: Option<PerPoint<ContactState>>,
    /// Forces of the floor on the points, N, world frame; as `contacts`.
    pub corner_forces: Option<PerPoint<[f64; 3]>>,
    /// The block that is thrown at the robot; `None` where there is none.
    pub block: Option<BlockSample>,
    /// Largest violation of a constraint, m or rad; zero where there is none.
    pub constraint: f64,
}

/// Why a step could not be made.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum StepFailure {
    /// The equations of motion have no solution here.
    #[error("{0}")]
    Dynamics(#[from] DynamicsFault),
    /// A variational step's equations have not been solved.
    #[error("{0}")]
    Step(#[from] StepError),
    /// The robot is no system of the multibody simulator, or the state no start of it.
    #[error("{0}")]
    System(#[from] SystemError),
    /// The constraints of welded feet are dependent: some leg is singular.
    #[error("the constraints of the welded feet are dependent (a straight leg)")]
    SingularConstraints,
    /// The state is not a number any more, or far beyond any motion: the step is too large.
    #[error("velocity {index} grew to {value:.1e}: the step is too large for this floor or motion")]
    Diverged {
        /// Index of the velocity.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// The same of a thrown block.
    #[error("the block's speed grew to {value:.1e}: the step is too large for its contact")]
    BlockDiverged {
        /// m/s or rad/s
        value: f64,
    },
}

/// Speeds beyond this (m/s or rad/s) are taken as divergence: no motion of a person-sized robot has
/// them.
const DIVERGED: f64 = 1e4;

/// A legged robot that moves under joint torques.
pub trait Plant {
    /// Writes the present state; without an allocation into one of this plant.
    ///
    /// # Errors
    /// A [`StepFailure`] where momenta belong to no velocities.
    fn read_state(&mut self, state: &mut PlantState) -> Result<(), StepFailure>;

    /// The present state.
    ///
    /// # Errors
    /// As for [`Self::read_state`].
    fn state(&mut self) -> Result<PlantState, StepFailure> {
        let mut state = PlantState::default();
        self.read_state(&mut state)?;
        Ok(state)
    }

    /// Advances by one step of `step_s` seconds under torques (N·m, one a joint in the robot's order), and a load on
    /// the central body (force and moment about its centre of mass, world axes), if there is one.
    ///
    /// # Errors
    /// A [`StepFailure`]; the state is then that before the step.
    fn step(
        &mut self,
        step_s: f64,
        torques: &[f64],
        load: Option<Wrench<f64>>,
    ) -> Result<(), StepFailure>;

    /// Writes the contact states after the last step, by foot and point, and tells whether the plant has any; without
    /// an allocation into those of this plant.
    fn read_contacts(&self, contacts: &mut PerPoint<ContactState>) -> bool;

    /// Contact states after the last step, by foot and point; `None` where the plant has none.
    fn contacts(&self) -> Option<PerPoint<ContactState>> {
        let mut contacts = PerPoint::new();
        self.read_contacts(&mut contacts).then_some(contacts)
    }

    /// Whether a thrown block touched the central body in the last step.
    fn is_struck(&self) -> bool {
        false
    }

    /// Energies, contact and constraints at the present state.
    ///
    /// # Errors
    /// A [`StepFailure`] for a state that no step has made, and that is no configuration.
    fn observe(&mut self) -> Result<Observation, StepFailure>;

    /// Largest step for which the plant is stable, as far as it can be told beforehand, s; `None`
    /// where nothing limits it but accuracy.
    fn step_limit(&self) -> Option<f64>;

    /// What a step solves for.
    fn unknowns(&self) -> usize;

    /// What the solver of implicit steps has done; `None` for plants without one.
    fn progress(&self) -> Option<&Progress> {
        None
    }

    /// All that is needed to go on from here; `None` for plants that cannot be taken up again.
    fn checkpoint(&self) -> Option<&Checkpoint> {
        None
    }

    /// Goes on from a checkpoint.
    ///
    /// # Errors
    /// [`StepFailure::System`] for a checkpoint of another plant, and for plants that cannot be taken up
    /// again.
    fn restore(&mut self, _: &Checkpoint) -> Result<(), StepFailure> {
        Err(SystemError::OtherCheckpoint.into())
    }
}

/// Contact states by foot into those that have been read before.
fn fill_contacts(
    feet: impl ExactSizeIterator<Item: Iterator<Item = ContactState>>,
    contacts: &mut PerPoint<ContactState>,
) {
    contacts.resize_with(feet.len(), Vec::new);
    for (own, states) in contacts.iter_mut().zip(feet) {
        own.clear();
        own.extend(states);
    }
}

/// A load on the central body, in its frame.
fn in_body(load: &Wrench<f64>, pose: &Pose<f64>) -> Wrench<f64> {
    let turn = |v: &nalgebra::Vector3<f64>| pose.rotation.tr_mul(v);
    Wrench { force: turn(&load.force), torque: turn(&load.torque) }
}

fn check_velocities(velocities: &[f64]) -> Result<(), StepFailure> {
    match velocities.iter().position(|v| !(v.abs() <= DIVERGED)) {
        Some(index) => Err(StepFailure::Diverged { index, value: velocities[index] }),
        None => Ok(()),
    }
}

//! Plants: robots that move under torques.

mod biped_model;
mod biped_system;
mod configuration;
mod energies;
mod joint_stops;
mod on_floor;
mod struck;
mod thrown_block;
mod variational;
mod welded;

pub use biped_model::{BipedModel, SMALL_BODIES};
pub use configuration::retract;
pub use on_floor::OnFloor;
pub use struck::Struck;
pub use thrown_block::{BlockSample, ThrownBlock};
pub use variational::{Additions, Variational};
pub use welded::Welded;

use crate::contact::ContactState;
use crate::integrators::{Progress, StepError};
use crate::multibody::{Checkpoint, SystemError};
use surefoot::dynamics::DynamicsFault;
use surefoot::spatial::{Pose, Wrench};

/// Coordinates of the biped.
pub const NQ: usize = 19;
/// Velocities of the biped.
pub const NV: usize = 18;

/// State of a biped plant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlantState {
    /// Position and quaternion of the central body, joint angles.
    pub positions: [f64; NQ],
    /// Body twist of the central body, joint rates.
    pub velocities: [f64; NV],
}

/// What a plant shows besides its state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Observation {
    /// Kinetic energy, J.
    pub kinetic_energy: f64,
    /// Potential energy of gravity, floor at 0, and of the floor's and stops' springs, J.
    pub potential_energy: f64,
    /// Vertical force of the ground on the left and right foot, N.
    pub foot_forces: [f64; 2],
    /// Contact states by foot and corner (heel −y, heel +y, toe −y, toe +y); `None` where the plant
    /// has no contact points.
    pub contacts: Option<[[ContactState; 4]; 2]>,
    /// Forces of the floor on the corners, N, world frame; as `contacts`.
    pub corner_forces: Option<[[[f64; 3]; 4]; 2]>,
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

/// A biped that moves under joint torques.
pub trait Plant {
    /// The present state.
    ///
    /// # Errors
    /// A [`StepFailure`] where momenta belong to no velocities.
    fn state(&mut self) -> Result<PlantState, StepFailure>;

    /// Advances by one step of `step_s` seconds under torques (N·m, left leg then right, hip to
    /// foot), and a load on the central body (force and moment about its centre of mass, world axes), if
    /// there is one.
    ///
    /// # Errors
    /// A [`StepFailure`]; the state is then that before the step.
    fn step(
        &mut self,
        step_s: f64,
        torques: &[f64; 12],
        load: Option<Wrench<f64>>,
    ) -> Result<(), StepFailure>;

    /// Contact states after the last step, by foot and corner; `None` where the plant has none.
    fn contacts(&self) -> Option<[[ContactState; 4]; 2]>;

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
    fn unknowns(&self) -> usize {
        NV
    }

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

/// Wrench array of the tree's velocities: torques on the joints, none on the central body.
fn generalized(torques: &[f64; 12]) -> [f64; NV] {
    let mut all = [0.0; NV];
    all[6..].copy_from_slice(torques);
    all
}

/// A load on the central body, in its frame.
fn in_body(load: &Wrench<f64>, pose: &Pose<f64>) -> Wrench<f64> {
    let turn = |v: &nalgebra::Vector3<f64>| pose.rotation.tr_mul(v);
    Wrench { force: turn(&load.force), torque: turn(&load.torque) }
}

fn check_velocities(velocities: &[f64; NV]) -> Result<(), StepFailure> {
    match velocities.iter().position(|v| !(v.abs() <= DIVERGED)) {
        Some(index) => Err(StepFailure::Diverged { index, value: velocities[index] }),
        None => Ok(()),
    }
}

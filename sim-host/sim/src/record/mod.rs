//! What a run leaves: samples, events, and their files.

mod csv;
mod estimate_errors;
mod event;
mod foxglove;
mod identity;
mod mechanism_record;
mod recorded;
mod robot_record;
mod saved;
mod settling;

pub use self::csv::write_csv;
pub use estimate_errors::{EstimateErrors, WorstErrors};
pub use event::{Event, EventKind};
pub use foxglove::{RecordFailure, write_mcap};
pub use identity::MotionIdentity;
pub use mechanism_record::MechanismRecord;
pub use recorded::{Details, JointReading, Record};
pub use robot_record::RobotRecord;
pub use saved::{
    EncoderMemory, HardwareMemory, MeasuredBefore, SavedMotion, SavedRun, SupervisorMemory,
};
pub use settling::Settling;

use crate::plant::{BlockSample, PerPoint};
use surefoot_multibody::contact::ContactState;

/// One sample, taken at a tick.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// s
    pub time_s: f64,
    /// Position and quaternion of the central body, joint angles.
    pub positions: Vec<f64>,
    /// Body twist of the central body, joint rates.
    pub velocities: Vec<f64>,
    /// Torques of the motors, N·m: what they give, delayed and cut, during the plant's step that begins
    /// here. Stops of joints press besides.
    pub torques: Vec<f64>,
    /// Wrench asked of the legs on the central body, in its frame: N, N·m.
    pub desired_wrench: [f64; 6],
    /// `p − p_d` of the true state, whatever the sensors say, world frame, m.
    pub position_error: [f64; 3],
    /// Orientation error of the true state, world frame, scalar first and not negative.
    pub orientation_error: [f64; 4],
    /// Vertical forces of the ground on the feet, N.
    pub foot_forces: Vec<f64>,
    /// By foot and point.
    pub contacts: Option<PerPoint<ContactState>>,
    /// Kinetic and potential energy, J; the latter of gravity, and of the floor's and stops' springs.
    pub energy: [f64; 2],
    /// Mean forces of the floor on the feet's points since the step before, N, world frame; by foot and point.
    pub corner_forces: Option<PerPoint<[f64; 3]>>,
    /// The thrown block, if there is one.
    pub block: Option<BlockSample>,
    /// Position, quaternion and body twist of the central body as the state estimator has them, if there is one.
    pub estimate: Option<[f64; 13]>,
}

impl Sample {
    /// Angle of the orientation error, rad, in [0, π].
    pub fn error_angle(&self) -> f64 {
        let [s, x, y, z] = self.orientation_error;
        2.0 * (x * x + y * y + z * z).sqrt().atan2(s)
    }

    /// Length of the position error, m.
    pub fn error_distance(&self) -> f64 {
        self.position_error.iter().map(|x| x * x).sum::<f64>().sqrt()
    }
}

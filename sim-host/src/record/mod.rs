//! What a run leaves: samples, events, and their files.

mod csv;
mod event;
mod foxglove;
mod identity;
mod mechanism_csv;
mod saved;
mod settling;

pub use self::csv::write_csv;
pub use event::{Event, EventKind};
pub use foxglove::{RecordFailure, write_mcap};
pub use identity::MotionIdentity;
pub use mechanism_csv::write_mechanism_csv;
pub use saved::{HardwareMemory, MeasuredBefore, SavedMotion, SavedRun, SupervisorMemory};
pub use settling::Settling;

use crate::contact::ContactState;
use crate::plant::{BlockSample, NQ, NV};

/// One sample, taken at a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// s
    pub time_s: f64,
    /// Position and quaternion of the central body, joint angles.
    pub positions: [f64; NQ],
    /// Body twist of the central body, joint rates.
    pub velocities: [f64; NV],
    /// Torques of the motors, N·m: what they give, delayed and cut, during the plant's step that begins
    /// here. Stops of joints press besides.
    pub torques: [f64; 12],
    /// Wrench asked of the legs on the central body, in its frame: N, N·m.
    pub desired_wrench: [f64; 6],
    /// `p − p_d` of the true state, whatever the sensors say, world frame, m.
    pub position_error: [f64; 3],
    /// Orientation error of the true state, world frame, scalar first and not negative.
    pub orientation_error: [f64; 4],
    /// Vertical forces of the ground on the feet, N.
    pub foot_forces: [f64; 2],
    /// By foot and corner.
    pub contacts: Option<[[ContactState; 4]; 2]>,
    /// Kinetic and potential energy, J; the latter of gravity, and of the floor's and stops' springs.
    pub energy: [f64; 2],
    /// Mean forces of the floor on the corners since the step before, N, world frame; by foot and corner.
    pub corner_forces: Option<[[[f64; 3]; 4]; 2]>,
    /// The thrown block, if there is one.
    pub block: Option<BlockSample>,
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

/// Names of the joints in the order of torques and angles, with the dissertation's numbers.
pub const JOINTS: [&str; 12] = [
    "left hip x (2)",
    "left hip y (3)",
    "left hip z (4)",
    "left knee (5)",
    "left ankle x (6)",
    "left ankle y (7)",
    "right hip x (8)",
    "right hip y (9)",
    "right hip z (10)",
    "right knee (11)",
    "right ankle x (12)",
    "right ankle y (13)",
];

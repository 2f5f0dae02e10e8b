//! The robot that this image is for: its `robot.rs`, by name of the build script.

/// More than firmware needs stands there, in the form of a program's output.
#[allow(dead_code, missing_docs, clippy::all)]
mod of_file {
    include!(concat!(env!("OUT_DIR"), "/robot.rs"));
    #[cfg(not(walks))]
    pub use described::firmware::GAINS;
    #[cfg(not(whole_body))]
    pub use described::firmware::{FINGERPRINT, LEGS, LIMITS, ROBOT, SOLES};
    pub use described::firmware::{ORIENTATION, POSITION};
    #[cfg(whole_body)]
    pub use described::whole_body::*;
    #[cfg(all(estimates, not(whole_body)))]
    pub use described::whole_body::{COORDINATES, FEET, NODES, TREE, VELOCITIES};
}

#[cfg(not(walks))]
pub use of_file::GAINS;
#[cfg(any(whole_body, estimates))]
pub use of_file::{COORDINATES, NODES, VELOCITIES};
#[cfg(whole_body)]
pub use of_file::{JOINTS, ROWS};
#[cfg(not(whole_body))]
pub use of_file::{LEGS as ROWS, LEGS as FEET, SOLES};
#[cfg(not(walks))]
use surefoot::balance::Gains;
use surefoot::balance::{Reference, SafetyLimits};
use surefoot::spatial::Quaternion;
#[cfg(not(walks))]
use surefoot::spatial::SymmetricMatrix3;
use surefoot_link::{RobotId, frame_bytes};

/// The robot, in flash.
#[cfg(not(whole_body))]
pub static ROBOT: surefoot::balance::LeggedRobot<f32, ROWS> = of_file::ROBOT;

/// All that moves, in flash.
#[cfg(any(whole_body, estimates))]
pub static MODEL: surefoot::model::Tree<f32, NODES, COORDINATES, VELOCITIES> = of_file::TREE;

/// What its supervisor allows: settings may be tighter, and no wider.
pub static LIMITS: SafetyLimits<f32, ROWS> = {
    #[cfg(not(walks))]
    let limits = of_file::LIMITS;
    #[cfg(walks)]
    let limits = of_file::LIMITS.with_rates(surefoot::walk::LANDING_RATE);
    #[cfg(estimates)]
    let limits = {
        use surefoot::estimate::{ANGULAR_VELOCITY_STEPS, VELOCITY_STEPS};
        limits.with_steps(VELOCITY_STEPS, ANGULAR_VELOCITY_STEPS)
    };
    limits
};

/// Joints are supervised in rows of so many: a leg's, where all legs have six.
pub const ROW: usize = 6;

/// Joints of the robot, and of its messages.
#[cfg(not(whole_body))]
pub const JOINTS: usize = ROW * ROWS;

/// Its feet.
#[cfg(whole_body)]
pub const FEET: usize = feet(&of_file::FEET);
/// The same, as the file has them, without the places of feet that it does not have.
#[cfg(any(whole_body, estimates))]
pub const ON_FEET: [Option<surefoot::balance::WholeBodyFoot<f32>>; feet(&of_file::FEET)] = {
    let mut own = [None; feet(&of_file::FEET)];
    let mut foot = 0;
    while foot < own.len() {
        own[foot] = of_file::FEET[foot];
        foot += 1;
    }
    own
};

/// Places up to the last that has a foot.
#[cfg(any(whole_body, estimates))]
const fn feet(places: &[Option<surefoot::balance::WholeBodyFoot<f32>>]) -> usize {
    let mut count = places.len();
    while count > 1 && places[count - 1].is_none() {
        count -= 1;
    }
    count
}

/// Bytes of the largest frame.
pub const FRAME: usize = frame_bytes(JOINTS);

/// What the other end knows it by.
#[cfg(not(whole_body))]
pub const ID: RobotId = RobotId::of(&of_file::ROBOT, &of_file::LIMITS);
/// What the other end knows it by.
#[cfg(whole_body)]
pub const ID: RobotId = RobotId::of_tree(&of_file::TREE, NODES, &of_file::FEET, &of_file::LIMITS);

const _: () = assert!(
    ID.fingerprint == of_file::FINGERPRINT,
    "robot.rs is not as it was written: edit robot.toml, and let `surefoot import` write both"
);
const _: () = assert!(JOINTS <= u8::MAX as usize && JOINTS <= ROW * ROWS);

/// Gains of a message or of the robot's file, by their diagonals.
#[cfg(not(walks))]
pub fn gains(diagonals: [[f32; 3]; 4]) -> Gains<f32> {
    let [position, velocity, orientation, angular_velocity] =
        diagonals.map(|[x, y, z]| SymmetricMatrix3::diagonal(x, y, z));
    Gains { position, velocity, orientation, angular_velocity }
}

/// The pose to hold after a reset.
pub fn reference() -> Reference<f32> {
    Reference::at_rest(of_file::POSITION.into(), Quaternion::from_array(of_file::ORIENTATION))
}

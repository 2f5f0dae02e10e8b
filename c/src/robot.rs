//! The robot that this library is for: its `robot.rs`, by name of the build script.

/// More than is needed here stands there, in the form of a program's output.
#[allow(dead_code, missing_docs, clippy::all)]
mod of_file {
    include!(concat!(env!("OUT_DIR"), "/robot.rs"));
    pub use described::firmware::*;
}

pub(crate) use of_file::{GAINS, SOLES};
use surefoot::balance::{LeggedRobot, Reference, SafetyLimits};
use surefoot::spatial::Quaternion;

/// Joints of a leg.
pub(crate) const LEG: usize = 6;
/// Legs of the robot.
pub const SUREFOOT_LEGS: usize = of_file::LEGS;
/// Joints of the robot.
pub const SUREFOOT_JOINTS: usize = LEG * SUREFOOT_LEGS;

/// Its name, ends with a zero.
pub(crate) static NAME: [u8; of_file::NAME.len() + 1] = {
    let (mut name, bytes) = ([0; of_file::NAME.len() + 1], of_file::NAME.as_bytes());
    let mut k = 0;
    while k < bytes.len() {
        name[k] = bytes[k];
        k += 1;
    }
    name
};

/// The same sizes for programs that read them when they run.
#[unsafe(no_mangle)]
#[allow(non_upper_case_globals, reason = "a name of C")]
pub static surefoot_legs: usize = SUREFOOT_LEGS;
/// See `surefoot_legs`.
#[unsafe(no_mangle)]
#[allow(non_upper_case_globals, reason = "a name of C")]
pub static surefoot_joints: usize = SUREFOOT_JOINTS;

/// The robot, in flash.
pub(crate) static ROBOT: LeggedRobot<f32, SUREFOOT_LEGS> = of_file::ROBOT;
/// What its supervisor allows.
pub(crate) static LIMITS: SafetyLimits<f32, SUREFOOT_LEGS> = of_file::LIMITS;

/// The pose to hold until another one is said.
pub(crate) fn reference() -> Reference<f32> {
    Reference::at_rest(of_file::POSITION.into(), Quaternion::from_array(of_file::ORIENTATION))
}

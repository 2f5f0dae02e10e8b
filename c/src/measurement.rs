//! A measured state.

use crate::robot::{LEG, SUREFOOT_JOINTS, SUREFOOT_LEGS};
use surefoot::balance::RobotState;
use surefoot::spatial::{Quaternion, Twist};

/// A measured state. Joints are those of the robot's file in its order: leg after leg, hip to foot.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurefootMeasurement {
    /// Of the central body's centre of mass, m, world frame.
    pub position: [f32; 3],
    /// World from central body, a unit quaternion, scalar first.
    pub orientation: [f32; 4],
    /// Of the central body in its own axes: of its centre of mass, m/s, and angular, rad/s.
    pub velocity: [f32; 6],
    /// rad
    pub joint_angles: [f32; SUREFOOT_JOINTS],
    /// rad/s
    pub joint_rates: [f32; SUREFOOT_JOINTS],
    /// Whether each foot touches the ground; read where limits of the ground are looked at.
    pub feet_touch: [bool; SUREFOOT_LEGS],
}

impl SurefootMeasurement {
    /// As the core takes it.
    pub(crate) fn state(&self) -> RobotState<f32, SUREFOOT_LEGS> {
        RobotState {
            position: self.position.into(),
            orientation: Quaternion::from_array(self.orientation),
            velocity: Twist::from_array(self.velocity),
            joint_angles: by_leg(&self.joint_angles),
            joint_rates: by_leg(&self.joint_rates),
        }
    }
}

fn by_leg(all: &[f32; SUREFOOT_JOINTS]) -> [[f32; LEG]; SUREFOOT_LEGS] {
    let mut legs = [[0.0; LEG]; SUREFOOT_LEGS];
    for (to, from) in legs.as_flattened_mut().iter_mut().zip(all) {
        *to = *from;
    }
    legs
}

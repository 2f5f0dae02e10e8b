//! Constants of a controller.

use crate::robot;
use surefoot::balance::{Gains, Ground};
use surefoot::spatial::SymmetricMatrix3;

/// Constants of a controller. `surefoot_default_settings` gives those of the robot's file.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurefootSettings {
    /// Seconds between ticks.
    pub period: f32,
    /// Diagonals of the gains: position, 1/s².
    pub position_gain: [f32; 3],
    /// Velocity, 1/s.
    pub velocity_gain: [f32; 3],
    /// Orientation, 1/s².
    pub orientation_gain: [f32; 3],
    /// Angular velocity, 1/s.
    pub angular_velocity_gain: [f32; 3],
    /// Whether the feet's wrenches are kept within what follows, and within the soles and the motors' torques.
    pub is_limited: bool,
    /// Of the ground; the controller uses all of it.
    pub friction: f32,
    /// Least force on a foot that touches, N.
    pub least_force: f32,
    /// Greatest force on a foot, N.
    pub greatest_force: f32,
    /// Share of the soles' lengths that is used, 0 to 1.
    pub sole_share: f32,
}

impl SurefootSettings {
    /// Of the robot's file, without limits of the ground; those that are written beside are the usual ones.
    pub(crate) fn of_robot() -> Self {
        let [position, velocity, orientation, angular_velocity] = robot::GAINS;
        Self {
            period: 1e-3,
            position_gain: position,
            velocity_gain: velocity,
            orientation_gain: orientation,
            angular_velocity_gain: angular_velocity,
            is_limited: false,
            friction: 0.3,
            least_force: 5.0,
            greatest_force: 1e4,
            sole_share: 0.92,
        }
    }

    /// As the core takes them; `None` where one is no gain.
    pub(crate) fn gains(&self) -> Option<Gains<f32>> {
        let all = [
            self.position_gain,
            self.velocity_gain,
            self.orientation_gain,
            self.angular_velocity_gain,
        ];
        if !all.as_flattened().iter().all(|gain| gain.is_finite() && *gain >= 0.0) {
            return None;
        }
        let [position, velocity, orientation, angular_velocity] =
            all.map(|[x, y, z]| SymmetricMatrix3::diagonal(x, y, z));
        Some(Gains { position, velocity, orientation, angular_velocity })
    }

    /// The same of the ground.
    pub(crate) fn ground(&self) -> Ground<f32> {
        Ground {
            least_force: self.least_force,
            greatest_force: self.greatest_force,
            friction: self.friction,
        }
    }
}

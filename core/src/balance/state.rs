//! What goes into a tick: the measured state, and what is wanted.

use super::robot::LEG;
use crate::spatial::{Quaternion, Twist};
use nalgebra::Vector3;

/// The measured state of a legged robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RobotState<T, const LEGS: usize> {
    /// Centre of mass of the central body in the world, m.
    pub position: Vector3<T>,
    /// World from central body, unit quaternion.
    pub orientation: Quaternion<T>,
    /// Body twist of the central body: velocity of its centre of mass and angular velocity, both in
    /// its own frame (m/s, rad/s).
    pub velocity: Twist<T>,
    /// Joint angles by leg, hip to foot, rad.
    pub joint_angles: [[T; LEG]; LEGS],
    /// Joint rates, rad/s.
    pub joint_rates: [[T; LEG]; LEGS],
}

/// The trajectory point that the central body is to follow, in the world frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reference<T> {
    /// `p_d`, m.
    pub position: Vector3<T>,
    /// m/s
    pub velocity: Vector3<T>,
    /// m/s²
    pub acceleration: Vector3<T>,
    /// `q_d`, world from desired body frame, unit quaternion.
    pub orientation: Quaternion<T>,
    /// `ω_d`, spatial angular velocity of the desired frame, rad/s.
    pub angular_velocity: Vector3<T>,
    /// rad/s²
    pub angular_acceleration: Vector3<T>,
}

impl<T: crate::Real> Reference<T> {
    /// A pose to hold.
    pub fn at_rest(position: Vector3<T>, orientation: Quaternion<T>) -> Self {
        Self {
            position,
            velocity: Vector3::zeros(),
            acceleration: Vector3::zeros(),
            orientation,
            angular_velocity: Vector3::zeros(),
            angular_acceleration: Vector3::zeros(),
        }
    }
}

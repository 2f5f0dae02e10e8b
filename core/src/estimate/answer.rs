//! What a step gives.

use super::Health;
use crate::Real;
use crate::balance::{RobotState, WholeBodyState};
use crate::spatial::{Quaternion, Twist};
use nalgebra::Vector3;

/// The central body, as controllers take it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate<T> {
    /// Its centre of mass in the world, m.
    pub position: Vector3<T>,
    /// World from central body, unit quaternion.
    pub orientation: Quaternion<T>,
    /// Body twist: velocity of its centre of mass, angular velocity (mean over the tick), m/s, rad/s.
    pub velocity: Twist<T>,
}

/// How far a foot was from what the filter predicted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Innovation<T> {
    /// (4), body axes, m.
    pub position: Vector3<T>,
    /// (5), body axes, rad; zero of a point.
    pub orientation: Vector3<T>,
    /// It was beyond the gate: the foot was made anew.
    pub is_reset: bool,
}

/// A step's answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EstimateReport<T, const FEET: usize> {
    /// Where the robot is.
    pub estimate: Estimate<T>,
    /// Of the feet that were measured in this tick.
    pub innovations: [Option<Innovation<T>>; FEET],
    /// What is out of bounds.
    pub health: Health<T>,
}

impl<T: Real> Estimate<T> {
    /// With joint angles and rates, for controllers of legs of six joints.
    pub fn robot_state<const LEGS: usize>(
        &self,
        joint_angles: [[T; 6]; LEGS],
        joint_rates: [[T; 6]; LEGS],
    ) -> RobotState<T, LEGS> {
        let Self { position, orientation, velocity } = *self;
        RobotState { position, orientation, velocity, joint_angles, joint_rates }
    }

    /// The central body's coordinates (position, quaternion) and velocities (body twist) in the state of any tree
    /// whose body 0 is the central one.
    pub fn write<const NQ: usize, const NV: usize>(&self, state: &mut WholeBodyState<T, NQ, NV>) {
        let pose = self.position.iter().copied().chain(self.orientation.to_array());
        state.positions.iter_mut().zip(pose).for_each(|(to, x)| *to = x);
        let twist = self.velocity.to_array();
        state.velocities.iter_mut().zip(twist).for_each(|(to, x)| *to = x);
    }
}

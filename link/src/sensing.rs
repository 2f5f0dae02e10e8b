//! What sensors tell of a robot whose state the target estimates, what its filter and its observer are told
//! before, and what they have found.

use crate::joints::Joints;
use crate::limits::MOST_FEET;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};
use surefoot::balance::RobotState;
use surefoot::estimate::{Estimator, FootKind, ImuReading, OutOfBounds, SensorNoise, StartPose};
use surefoot::spatial::{Pose, Quaternion, Twist};

/// What sensors read at a tick.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Readings<const JOINTS: usize> {
    /// Mean specific force over the tick that ends now, sensor's axes, m/s².
    pub accelerometer: [f32; 3],
    /// Mean angular velocity over it, rad/s.
    pub gyroscope: [f32; 3],
    /// rad
    pub joint_angles: Joints<f32, JOINTS>,
    /// rad/s
    pub joint_rates: Joints<f32, JOINTS>,
    /// Feet whose switches are closed: bit 0 is the first.
    pub switches: u8,
    /// Which feet touch the ground, as of [`Sensors`](crate::Sensors).
    pub contacts: u8,
    /// Normal forces on the feet, N; none where the robot does not walk.
    pub forces: Joints<f32, MOST_FEET>,
}

/// A state estimator, and where the robot stands when it begins.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FilterSettings {
    /// s
    pub period: f32,
    /// m/s²
    pub gravity: f32,
    /// Of sensors and ground.
    pub noise: SensorNoise<f32>,
    /// The inertial sensor from the central body's centre of mass, m.
    pub imu_position: [f32; 3],
    /// Central body from inertial sensor, scalar first.
    pub imu_orientation: [f32; 4],
    /// The middle of the feet that stand, m.
    pub feet: [f32; 3],
    /// Yaw of the central body, rad.
    pub heading: f32,
}

/// An observer of disturbances, by its documented starting values.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ObserverSettings {
    /// kg
    pub mass: f32,
    /// m/s²
    pub gravity: f32,
    /// Of the central body above its feet, m.
    pub height: f32,
    /// Where the centre of mass is to stand from the mean of the feet, m.
    pub nominal: [f32; 2],
}

/// What a filter has made of a tick's readings.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Estimated {
    /// Position (m), quaternion (scalar first) and body twist (m/s, rad/s) of the central body.
    pub central: [f32; 13],
    /// Feet that were made anew because they were not where they had stood.
    pub made_anew: u8,
    /// What is farthest out of bounds.
    pub worst: Option<OutOfBounds<f32>>,
}

impl<const JOINTS: usize> Readings<JOINTS> {
    /// The inertial sensor's.
    pub fn imu(&self) -> ImuReading<f32> {
        ImuReading { accelerometer: self.accelerometer.into(), gyroscope: self.gyroscope.into() }
    }

    /// The joints' part of a state, whose central body is at the origin.
    pub fn joints<const LEGS: usize>(&self) -> RobotState<f32, LEGS> {
        RobotState {
            position: Vector3::zeros(),
            orientation: Quaternion::identity(),
            velocity: Twist::zero(),
            joint_angles: crate::by_leg(&self.joint_angles, 0.0),
            joint_rates: crate::by_leg(&self.joint_rates, 0.0),
        }
    }
}

impl FilterSettings {
    /// Of feet of these kinds; `None` for a sensor whose orientation is none. The rest is for
    /// [`Estimator::check`].
    pub fn estimator<const FEET: usize>(
        &self,
        feet: [Option<FootKind>; FEET],
    ) -> Option<Estimator<f32, FEET>> {
        let orientation = Quaternion::from_array(self.imu_orientation).normalized()?;
        let imu = Pose { rotation: orientation.to_matrix(), position: self.imu_position.into() };
        Some(Estimator {
            noise: self.noise,
            imu,
            ..Estimator::new(self.period, self.gravity, feet)
        })
    }

    /// Where the robot is when it begins.
    pub fn start(&self) -> StartPose<f32> {
        StartPose { feet: self.feet.into(), heading: self.heading }
    }
}

/// Bits of a byte by foot.
pub fn by_foot<const FEET: usize>(bits: u8) -> [bool; FEET] {
    core::array::from_fn(|foot| foot < 8 && bits & (1 << foot) != 0)
}

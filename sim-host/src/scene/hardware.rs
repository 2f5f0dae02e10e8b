//! What a robot's sensors, motors and joints do less well than a simulator's.

use serde::{Deserialize, Serialize};

/// Sensors. All fields are zero, and the sensors ideal, unless said.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Sensing {
    /// Counts of a joint's encoder a turn. Its rates are then differences of counts over a tick.
    pub encoder_counts: u32,
    /// Density of the gyroscope's noise, rad/s/√Hz.
    pub gyroscope_noise: f64,
    /// Density of the accelerometer's noise, m/s²/√Hz.
    pub accelerometer_noise: f64,
    /// Time in which the state estimate is drawn back to what legs and gravity tell, s; 1 s unless said.
    pub correction_s: f64,
    /// Seed of the noise.
    pub seed: u64,
}

impl Sensing {
    /// Whether it changes nothing.
    pub fn is_ideal(&self) -> bool {
        *self == Self::default()
    }
}

/// Motors and joints. Nothing limits them unless said.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Acting {
    /// From a measurement to its torques, s.
    pub delay_s: f64,
    /// Largest torques of a leg's joints, hip to foot, N·m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub torque_limits_nm: Option<[f64; 6]>,
    /// Ends of the joints' ways.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint_stops: Option<JointStops>,
}

impl Acting {
    /// Whether it changes nothing.
    pub fn is_ideal(&self) -> bool {
        *self == Self::default()
    }
}

/// Ends of the joints' ways: springs that press beyond them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct JointStops {
    /// Lowest and highest angles of the left leg's joints, hip to foot.
    pub left_deg: [[f64; 2]; 6],
    /// Of the right leg's.
    pub right_deg: [[f64; 2]; 6],
    /// N·m/rad
    pub stiffness: f64,
}

//! What a robot's sensors, motors and joints do less well than a simulator's.

use crate::multibody::Stops;
use serde::{Deserialize, Serialize};

/// Sensors. They are ideal unless said.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Sensing {
    /// Counts of a joint's encoder a turn; 0 for one that reads exactly. Rates are then differences of
    /// counts over a tick.
    pub encoder_counts: u32,
    /// Density of the gyroscope's noise, rad/s/√Hz: over `t` seconds its integral strays by `n √t` (the
    /// angle random walk of data sheets).
    pub gyroscope_noise: f64,
    /// Density of the accelerometer's noise, m/s²/√Hz, likewise.
    pub accelerometer_noise: f64,
    /// Time constant with which the state estimate is drawn back to what legs and gravity tell, s; 1 s
    /// unless said.
    pub correction_s: f64,
    /// Seed of the noise.
    pub seed: u64,
}

impl Default for Sensing {
    fn default() -> Self {
        Self {
            encoder_counts: 0,
            gyroscope_noise: 0.0,
            accelerometer_noise: 0.0,
            correction_s: 1.0,
            seed: 0,
        }
    }
}

impl Sensing {
    /// Whether the state is measured as it is.
    pub fn is_ideal(&self) -> bool {
        self.encoder_counts == 0 && !self.is_noisy()
    }

    /// Whether the inertial sensors are noisy.
    pub fn is_noisy(&self) -> bool {
        self.gyroscope_noise != 0.0 || self.accelerometer_noise != 0.0
    }
}

/// Motors and joints. Nothing limits them unless said.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Acting {
    /// From a measurement to its torques, s. It need not be a whole number of steps.
    pub delay_s: f64,
    /// Largest torques of a leg's motors either way, hip to foot, N·m.
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

impl JointStops {
    /// Of all joints in radians, left leg then right, hip to foot.
    pub fn in_radians(&self) -> [Stops; 12] {
        std::array::from_fn(|joint| {
            let [low, high] =
                if joint < 6 { self.left_deg[joint] } else { self.right_deg[joint - 6] };
            Stops { low: low.to_radians(), high: high.to_radians(), stiffness: self.stiffness }
        })
    }
}

//! What a robot's sensors, motors and joints do less well than a simulator's.

use crate::robot::Robot;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use surefoot_multibody::Stops;

/// What state reaches the controller.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum StateSource {
    /// The true one, whatever else is said of sensors.
    Truth,
    /// The true one with the errors of a filter that draws an inertial sensor back to what legs and gravity tell; none
    /// where none are said.
    #[default]
    Noise,
    /// What the state estimator makes of inertial sensor, encoders and foot switches.
    Estimate,
}

impl StateSource {
    /// As scenes write it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Truth => "truth",
            Self::Noise => "noise",
            Self::Estimate => "estimate",
        }
    }
}

/// Sensors. They are ideal unless said.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Sensing {
    /// What state reaches the controller.
    pub state: StateSource,
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
    /// What encoders read too much, by names of joints, degrees.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub encoder_bias_deg: BTreeMap<String, f64>,
    /// Play between each joint and its encoder, which sits on the motor's side, degrees: the encoder rests while the
    /// joint moves within it.
    pub backlash_deg: f64,
    /// How the inertial sensor is turned in the central body against where it is taken to be: a rotation vector in the
    /// body's axes, degrees.
    pub imu_tilt_deg: [f64; 3],
    /// What the gyroscope reads too much, its own axes, rad/s. The state estimate's orientation is off by this times
    /// `correction_s`.
    pub gyroscope_bias: [f64; 3],
    /// What the accelerometer reads too much, its own axes, m/s². Only of a state that is estimated: its tilt is off by
    /// this over gravity.
    pub accelerometer_bias: [f64; 3],
}

impl Default for Sensing {
    fn default() -> Self {
        Self {
            state: StateSource::default(),
            encoder_counts: 0,
            gyroscope_noise: 0.0,
            accelerometer_noise: 0.0,
            correction_s: 1.0,
            seed: 0,
            encoder_bias_deg: BTreeMap::new(),
            backlash_deg: 0.0,
            imu_tilt_deg: [0.0; 3],
            gyroscope_bias: [0.0; 3],
            accelerometer_bias: [0.0; 3],
        }
    }
}

impl Sensing {
    /// Whether the state is measured as it is, unless the table says just that.
    pub fn is_ideal(&self) -> bool {
        self.state == StateSource::Noise
            && self.encoder_counts == 0
            && self.encoder_bias_deg.is_empty()
            && self.backlash_deg == 0.0
            && !self.is_askew()
            && !self.is_noisy()
    }

    /// Whether the inertial sensor is turned or biased.
    pub fn is_askew(&self) -> bool {
        self.imu_tilt_deg != [0.0; 3] || self.gyroscope_bias != [0.0; 3]
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
    /// Time constant with which torques follow, s: that of a first-order lag.
    pub lag_s: f64,
    /// What of each torque is lost, N·m; smaller ones are lost whole.
    pub dead_zone_nm: f64,
    /// Ends of the joints' ways.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint_stops: Option<JointStops>,
    /// Stiffness of stops at the ends of the joints' own ranges, N·m/rad.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub range_stiffness: Option<f64>,
}

impl Acting {
    /// Whether it changes nothing.
    pub fn is_ideal(&self) -> bool {
        *self == Self::default()
    }

    /// The stops of a robot's joints, if there are any, in the order of torques.
    pub fn stops(&self, robot: &Robot) -> Option<Vec<Stops>> {
        let named = self.joint_stops.map(|stops| stops.in_radians().to_vec());
        let of_range = |stiffness: f64| {
            let ranges = robot.limits.joints.iter().map(|joint| joint.angle);
            ranges.map(|[low, high]| Stops { low, high, stiffness }).collect()
        };
        named.or_else(|| self.range_stiffness.map(of_range))
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

//! How a run ended.

use crate::record::Sample;
use crate::robot::Robot;
use serde::Serialize;

/// End of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Outcome {
    /// At the set point at the end: within 1 mm and 0.1°.
    Balanced,
    /// Upright at the end, but not at the set point.
    Completed,
    /// The controller's supervisor stopped the robot.
    Stopped,
    /// Ended before its time, by whoever followed it.
    Interrupted,
    /// The robot fell.
    Fell,
    /// The run could not go on.
    Failed,
}

/// Why a run ended early.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Failure {
    /// A word for programs: `stopped`, `fell`, `controller-fault`, `step`.
    pub kind: &'static str,
    /// When, s.
    pub time_s: f64,
    /// What failed, for people.
    #[serde(rename = "where")]
    pub place: String,
    /// What to try.
    pub advice: String,
}

/// A largest value, where and when.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Peak {
    /// Its signed value.
    pub value: f64,
    /// When, s.
    pub time_s: f64,
}

/// The largest values of a run that the text prints.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Peaks {
    /// Vertical desired force, N.
    pub force_z: Peak,
    /// Desired torque of largest size about x, y and z, N·m.
    pub torque: [Peak; 3],
    /// Torque of largest size of each joint, N·m.
    pub joints: Vec<Peak>,
}

impl Peaks {
    /// Of the samples' torques as given; `None` where there are no samples.
    pub fn of(samples: &[Sample]) -> Option<Self> {
        let peak = |value: &dyn Fn(&Sample) -> f64| {
            samples
                .iter()
                .map(|sample| Peak { value: value(sample), time_s: sample.time_s })
                .max_by(|a, b| a.value.abs().total_cmp(&b.value.abs()))
        };
        let first = peak(&|sample| sample.desired_wrench[2])?;
        let joints = vec![first; samples.first()?.torques.len()];
        let mut peaks = Self { force_z: first, torque: [first; 3], joints };
        for (i, torque) in peaks.torque.iter_mut().enumerate() {
            *torque = peak(&|sample| sample.desired_wrench[3 + i])?;
        }
        for (i, joint) in peaks.joints.iter_mut().enumerate() {
            *joint = peak(&|sample| sample.torques[i])?;
        }
        Some(peaks)
    }

    /// The joint of the robot with the largest torque of all: its name and peak.
    pub fn largest_joint<'a>(&self, robot: &'a Robot) -> Option<(&'a str, Peak)> {
        let mut best = 0;
        for (i, peak) in self.joints.iter().enumerate() {
            if peak.value.abs() > self.joints[best].value.abs() {
                best = i;
            }
        }
        Some((robot.joints.get(best)?, *self.joints.get(best)?))
    }
}

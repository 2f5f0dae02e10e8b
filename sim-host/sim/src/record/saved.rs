//! A run that stopped, to be taken up again.

use super::MotionIdentity;
use crate::closed_loop::Scalar;
use crate::written::write_text;
use serde::{Deserialize, Serialize};
use std::path::Path;
use surefoot::balance::{Mode, StopReason};
use surefoot_multibody::{BodyCheckpoint, Checkpoint, PlanarCheckpoint};

/// Where a run stopped. Numbers are written with as many digits as give back the same bits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SavedRun {
    /// Name of its scene, for people.
    pub scene: String,
    /// What decides its motion.
    pub motion: MotionIdentity,
    /// Precision of its controller, if that is known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scalar: Option<Scalar>,
    /// When it stopped, s.
    pub time_s: f64,
    /// Whether the controller's torques had set in; of no meaning without a controller.
    pub torques_on: bool,
    /// The motion.
    pub checkpoint: SavedMotion,
    /// What a robot's sensors and motors remember; none where they are ideal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hardware: Option<HardwareMemory>,
    /// What the controller's supervisor remembers; none where there is none on this side.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub supervisor: Option<SupervisorMemory>,
    /// Limits of ground and motors that bound at the last tick, by row and multiplier.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub limit_rows: Vec<(u8, f64)>,
    /// What the controller's observer of disturbances remembers; nothing where there is none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub observer: Vec<f64>,
}

/// All that a motion needs to go on, by the simulator that plays it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SavedMotion {
    /// Bodies and joints in space.
    Tree(Checkpoint),
    /// In a plane.
    Planar(PlanarCheckpoint),
    /// One free body.
    Body(BodyCheckpoint),
}

/// What sensors and motors remember of earlier ticks.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HardwareMemory {
    /// What encoders have read at the last tick.
    pub encoders: Option<EncoderMemory>,
    /// Torques on their way to the motors, oldest first, one set a tick, N·m.
    pub torques: Vec<Vec<f64>>,
    /// What lagging motors give, N·m; none of others.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lagging: Option<Vec<f64>>,
}

/// What encoders have read at a tick, one a joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EncoderMemory {
    /// Angles on the motors' side, rad.
    pub angles: Vec<f64>,
    /// What was read of them, rad.
    pub read: Vec<f64>,
}

impl EncoderMemory {
    /// Whether it is of so many joints.
    pub fn fits(&self, joints: usize) -> bool {
        self.angles.len() == joints && self.read.len() == joints
    }
}

/// What a supervisor remembers of earlier ticks, leg by leg.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(missing_docs)] // Each is the field of that name of the core's `SupervisorMemory`.
pub struct SupervisorMemory {
    pub mode: Mode,
    pub reason: Option<StopReason>,
    pub torques: Vec<f64>,
    pub before: Option<MeasuredBefore>,
    pub missed: u8,
    pub owed: u16,
    pub doubtful: u8,
    pub falling: u16,
    pub saturated: u16,
    pub highest: Option<f64>,
    pub cut: u32,
}

/// The measurement that the next one is compared with.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(missing_docs)] // Each is the field of that name of the core's `Before`.
pub struct MeasuredBefore {
    pub positions: Vec<f64>,
    pub velocities: Vec<f64>,
    pub velocity: [f64; 3],
    pub unexplained: Vec<[u8; 4]>,
}

impl SavedRun {
    /// Writes it as JSON.
    ///
    /// # Errors
    /// What went wrong, with the file's name.
    pub fn write(&self, path: &Path) -> Result<(), String> {
        let context = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
        let text = serde_json::to_string_pretty(self).map_err(|error| context(&error))?;
        write_text(path, &text)
    }

    /// Reads it.
    ///
    /// # Errors
    /// What went wrong, with the file's name, and where in it.
    pub fn read(path: &Path) -> Result<Self, String> {
        let context = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
        let text = std::fs::read_to_string(path).map_err(|error| context(&error))?;
        serde_json::from_str(&text).map_err(|error| context(&error))
    }
}

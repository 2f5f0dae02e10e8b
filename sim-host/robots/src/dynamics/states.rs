//! Files of states, in and out: the layout is the same, so that one tool's output is another's input.
//!
//! ```json
//! { "base": "floating",
//!   "joints": [{ "name": "root_joint", "idx_q": 0, "nq": 7, "idx_v": 0, "nv": 6 }, …],
//!   "states": [{ "q": […], "v": […], "a": […], "tau": […] }, …] }
//! ```
//! Results stand beside them in each state: `leaf_frames`, `rnea`, `crba`, `aba`.

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A file of states; what else it holds is passed over.
#[derive(Debug, Deserialize)]
pub(super) struct States {
    /// `floating` or `fixed`.
    pub base: Option<Base>,
    /// m/s²; the robot's where it is missing.
    pub gravity: Option<[f64; 3]>,
    /// Where each joint's numbers are.
    pub joints: Vec<JointEntry>,
    /// The states.
    pub states: Vec<State>,
}

/// What carries the root link.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
pub(super) enum Base {
    /// The world.
    Fixed,
    /// Nothing.
    Floating,
}

/// Where a joint's numbers are in the arrays of a state.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct JointEntry {
    /// As in the robot's file.
    pub name: String,
    /// Pinocchio's type; only a floating root joint's matters.
    #[serde(rename = "type", default, skip_serializing_if = "Option::is_none")]
    pub kind: Option<String>,
    /// First coordinate, and how many.
    pub idx_q: usize,
    /// Coordinates.
    pub nq: usize,
    /// First velocity, and how many.
    pub idx_v: usize,
    /// Velocities.
    pub nv: usize,
}

/// One state.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct State {
    /// Coordinates.
    pub q: Vec<f64>,
    /// Velocities.
    pub v: Vec<f64>,
    /// Accelerations, for inverse dynamics; 0 where they are missing.
    #[serde(default)]
    pub a: Vec<f64>,
    /// Torques, for forward dynamics; 0 where they are missing.
    #[serde(default)]
    pub tau: Vec<f64>,
}

/// A state with what the algorithms give for it.
#[derive(Clone, Debug, Serialize)]
pub struct StateResult {
    /// The state.
    #[serde(flatten)]
    pub state: State,
    /// Poses of links that carry none, by name.
    pub leaf_frames: BTreeMap<String, FramePose>,
    /// Torques for `a`.
    pub rnea: Vec<f64>,
    /// Mass matrix, by rows.
    pub crba: Vec<Vec<f64>>,
    /// Accelerations under `tau`.
    pub aba: Vec<f64>,
}

/// World from frame.
#[derive(Clone, Debug, Serialize)]
pub struct FramePose {
    /// By rows.
    pub rotation: [[f64; 3]; 3],
    /// m
    pub translation: [f64; 3],
}

/// A file's states with their results.
#[derive(Clone, Debug, Serialize)]
pub struct Results {
    /// The robot's name.
    pub robot: String,
    /// `floating` or `fixed`.
    pub base: &'static str,
    /// m/s²
    pub gravity: [f64; 3],
    /// Coordinates of a state.
    pub nq: usize,
    /// Velocities of a state.
    pub nv: usize,
    /// With what is fixed to the world, kg.
    pub mass: f64,
    /// As the file has them.
    pub joints: Vec<JointEntry>,
    /// Each with its results.
    pub states: Vec<StateResult>,
}

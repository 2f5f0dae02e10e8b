//! Values that the problems are measured against.

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

const TEXT: &str = include_str!("../../benchmarks/references.json");

/// A problem's values.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Reference {
    /// How they were found.
    pub source: String,
    pub times: Vec<At>,
}

/// Values at a time.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct At {
    /// s
    pub t: f64,
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub bodies: BTreeMap<String, Pose>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bicycle: Option<Bicycle>,
}

/// Of a body.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Pose {
    /// Of the centre of mass, m.
    pub position: [f64; 3],
    /// World from body, scalar first.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub quaternion: Option<[f64; 4]>,
}

/// Of a bicycle, whose lean is about its heading.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Bicycle {
    /// rad
    pub roll: f64,
    /// rad
    pub steer: f64,
    /// rad/s
    pub roll_rate: f64,
    /// Of the rear hub, m/s.
    pub forward_speed: f64,
}

/// All, by problem.
///
/// # Errors
/// Never for the file as shipped: a test reads it.
pub(super) fn references() -> Result<BTreeMap<String, Reference>, serde_json::Error> {
    serde_json::from_str(TEXT)
}

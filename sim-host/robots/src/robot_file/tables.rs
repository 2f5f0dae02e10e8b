//! The tables of a `robot.toml`.

use serde::{Deserialize, Serialize};
use toml::Spanned;

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RobotTable {
    pub name: String,
    pub gravity_m_s2: [f64; 3],
    /// Of what is fixed to the world.
    #[serde(default, skip_serializing_if = "is_default")]
    pub fixed_mass_kg: f64,
    #[serde(default)]
    pub links: Vec<LinkTable>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub frames: Vec<FrameTable>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub feet: Vec<FootTable>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LinkTable {
    pub name: Spanned<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub parent: Option<String>,
    pub mass_kg: f64,
    #[serde(default, skip_serializing_if = "is_default")]
    pub center_m: [f64; 3],
    #[serde(default, skip_serializing_if = "is_default")]
    pub inertia_kg_m2: [f64; 6],
    pub joint: JointTable,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct JointTable {
    pub name: String,
    pub kind: Kind,
    #[serde(default, skip_serializing_if = "is_default")]
    pub position_m: [f64; 3],
    #[serde(default = "upright", skip_serializing_if = "is_upright")]
    pub orientation: [f64; 4],
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axis: Option<[f64; 3]>,
    #[serde(default, skip_serializing_if = "is_default")]
    pub point_m: [f64; 3],
    #[serde(skip_serializing_if = "Option::is_none")]
    pub range: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rate: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub effort: Option<f64>,
    #[serde(default, skip_serializing_if = "is_default")]
    pub armature: f64,
    #[serde(default, skip_serializing_if = "is_default")]
    pub damping: f64,
    #[serde(default, skip_serializing_if = "is_default")]
    pub friction: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub follows: Option<FollowsTable>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FollowsTable {
    pub joint: String,
    pub multiplier: f64,
    pub offset: f64,
}

#[derive(Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Kind {
    Revolute,
    Continuous,
    Prismatic,
    Spherical,
    Floating,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FrameTable {
    pub name: Spanned<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub link: Option<String>,
    #[serde(default, skip_serializing_if = "is_default")]
    pub position_m: [f64; 3],
    #[serde(default = "upright", skip_serializing_if = "is_upright")]
    pub orientation: [f64; 4],
    /// Whether nothing hung from it in the file that it comes from.
    #[serde(default)]
    pub leaf: bool,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FootTable {
    pub name: Spanned<String>,
    pub link: String,
    pub points_m: Vec<[f64; 3]>,
}

pub(super) fn is_default<T: Default + PartialEq>(x: &T) -> bool {
    *x == T::default()
}

pub(super) fn upright() -> [f64; 4] {
    [1.0, 0.0, 0.0, 0.0]
}

pub(super) fn is_upright(q: &[f64; 4]) -> bool {
    *q == upright()
}

//! Scenes of bodies and joints of one's own.
//!
//! Everything is described as it is at the start, in world axes: where bodies are, where joints are, which
//! way axes point. Joints' angles are counted from there.

mod build;
mod check;
mod misdescribed;

pub use misdescribed::{BuildError, Misdescribed};

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};
use surefoot_multibody::JointLaw;
use surefoot_multibody::contact::{Floor, Switching};

/// Bodies, joints, and what they touch.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Multibody {
    /// m/s², against z.
    pub gravity_m_s2: f64,
    /// Bodies, each after the one it hangs from.
    pub bodies: Vec<BodyEntry>,
    /// Joints that close loops.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub loops: Vec<LoopEntry>,
    /// What contact points can touch; without it nothing of contact is computed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub floor: Option<Floor>,
    /// When points enter and leave the floor.
    #[serde(default)]
    pub switching: Switching,
}

/// A body and the joint that holds it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BodyEntry {
    /// For people, and for other bodies to name.
    pub name: String,
    /// The body it hangs from; none for the world.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inboard: Option<String>,
    /// kg
    pub mass_kg: f64,
    /// Principal inertias about the centre of mass, kg·m².
    pub inertia_kg_m2: [f64; 3],
    /// Centre of mass, m.
    pub center_m: [f64; 3],
    /// Of the principal axes, world from body, scalar first.
    #[serde(default = "upright")]
    pub orientation: [f64; 4],
    /// The joint.
    pub joint: JointEntry,
    /// Its spring, damper and stops.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub law: Option<JointLaw>,
    /// Held in the joint, N·m or N; of revolute and prismatic ones only.
    #[serde(default)]
    pub torque: f64,
    /// Points that can touch the floor, in the body's frame, m.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub contact_points_m: Vec<[f64; 3]>,
}

/// A joint, with its velocity.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum JointEntry {
    /// None: the body is free.
    Floating {
        /// Of the centre of mass, m/s.
        #[serde(default)]
        velocity_m_s: [f64; 3],
        /// World axes, rad/s.
        #[serde(default)]
        angular_velocity_rad_s: [f64; 3],
    },
    /// No motion.
    Fixed {},
    /// About an axis through a point.
    Revolute {
        /// m
        point_m: [f64; 3],
        /// Of any length.
        axis: [f64; 3],
        /// rad/s
        #[serde(default)]
        rate_rad_s: f64,
    },
    /// Along an axis.
    Prismatic {
        /// Of any length.
        axis: [f64; 3],
        /// m/s
        #[serde(default)]
        rate_m_s: f64,
    },
    /// About two axes through a point, at a right angle.
    Universal {
        /// m
        point_m: [f64; 3],
        /// Fixed to the inboard, and to the outboard body.
        axes: [[f64; 3]; 2],
        /// rad/s
        #[serde(default)]
        rates_rad_s: [f64; 2],
    },
    /// About a point.
    Spherical {
        /// m
        point_m: [f64; 3],
        /// Of the body against its inboard one, world axes, rad/s.
        #[serde(default)]
        angular_velocity_rad_s: [f64; 3],
    },
}

/// A joint that closes a loop.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LoopEntry {
    /// The bodies that it joins; the second may be left out for the world.
    pub between: Vec<String>,
    /// The joint.
    pub joint: LoopJoint,
}

/// A joint that closes a loop: where it is. Its velocity is that of its bodies, and may be given as zero only.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum LoopJoint {
    /// No motion.
    Fixed {},
    /// About an axis through a point.
    Revolute {
        /// m
        point_m: [f64; 3],
        /// Of any length.
        axis: [f64; 3],
        /// rad/s
        #[serde(default, skip_serializing)]
        rate_rad_s: Zero,
    },
    /// Along an axis.
    Prismatic {
        /// Of any length.
        axis: [f64; 3],
        /// m/s
        #[serde(default, skip_serializing)]
        rate_m_s: Zero,
    },
    /// About two axes through a point, at a right angle.
    Universal {
        /// m
        point_m: [f64; 3],
        /// Fixed to the second, and to the first body.
        axes: [[f64; 3]; 2],
        /// rad/s
        #[serde(default, skip_serializing)]
        rates_rad_s: Zero,
    },
    /// About a point.
    Spherical {
        /// m
        point_m: [f64; 3],
        /// rad/s
        #[serde(default, skip_serializing)]
        angular_velocity_rad_s: Zero,
    },
}

/// A number, or several, that can only be zero.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Zero;

impl<'de> Deserialize<'de> for Zero {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(untagged)]
        enum Numbers {
            One(f64),
            Several(Vec<f64>),
        }
        let is_zero = match Numbers::deserialize(from)? {
            Numbers::One(x) => x == 0.0,
            Numbers::Several(all) => all.iter().all(|x| *x == 0.0),
        };
        let expected = "0, or nothing: a joint that closes a loop has the rate of its bodies";
        if is_zero { Ok(Self) } else { Err(D::Error::custom(format!("expected {expected}"))) }
    }
}

impl From<LoopJoint> for JointEntry {
    /// At rest.
    fn from(joint: LoopJoint) -> Self {
        match joint {
            LoopJoint::Fixed {} => Self::Fixed {},
            LoopJoint::Revolute { point_m, axis, .. } => {
                Self::Revolute { point_m, axis, rate_rad_s: 0.0 }
            }
            LoopJoint::Prismatic { axis, .. } => Self::Prismatic { axis, rate_m_s: 0.0 },
            LoopJoint::Universal { point_m, axes, .. } => {
                Self::Universal { point_m, axes, rates_rad_s: [0.0; 2] }
            }
            LoopJoint::Spherical { point_m, .. } => {
                Self::Spherical { point_m, angular_velocity_rad_s: [0.0; 3] }
            }
        }
    }
}

fn upright() -> [f64; 4] {
    [1.0, 0.0, 0.0, 0.0]
}

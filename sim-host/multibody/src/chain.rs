//! Chains of equal rods.

use super::body::{Body, BodyState};
use super::joint::{Joint, JointConstraint};
use super::system::{Link, System};
use super::system_error::SystemError;
use serde::{Deserialize, Serialize};

/// What joins a chain's rods.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ChainJoint {
    /// About y: the chain stays in a plane.
    Revolute,
    /// About x and y in turn.
    Alternating,
    /// Ball joints.
    Spherical,
}

/// A chain of equal cylindrical rods, from its pivot on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chain {
    /// How many rods.
    pub links: usize,
    /// kg
    pub mass: f64,
    /// m
    pub length: f64,
    /// m
    pub radius: f64,
    /// What joins them.
    pub joint: ChainJoint,
    /// Whether the first rod floats, or hangs from the world.
    pub floats: bool,
    /// m/s²
    pub gravity: f64,
}

impl Chain {
    /// The system. Rods lie along their z axes.
    ///
    /// # Errors
    /// A [`SystemError`].
    pub fn system(&self) -> Result<System, SystemError> {
        let (m, l, r) = (self.mass, self.length, self.radius);
        let across = m * (3.0 * r * r + l * l) / 12.0;
        let body = Body { mass: m, inertia: [across, across, 0.5 * m * r * r] };
        let half = 0.5 * l;
        let (x, y) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
        let links = (0..self.links)
            .map(|k| {
                let inboard = k.checked_sub(1);
                let constraint = match self.joint {
                    _ if k == 0 && self.floats => JointConstraint::Floating,
                    ChainJoint::Spherical => JointConstraint::Spherical,
                    ChainJoint::Alternating if k % 2 == 0 => JointConstraint::Revolute { axis: x },
                    _ => JointConstraint::Revolute { axis: y },
                };
                let at = if inboard.is_some() { [0.0, 0.0, -half] } else { [0.0; 3] };
                Link {
                    inboard,
                    joint: Joint {
                        outboard: [0.0, 0.0, half],
                        inboard: at,
                        home: [1.0, 0.0, 0.0, 0.0],
                        constraint,
                    },
                    body,
                }
            })
            .collect();
        System::new(links, self.gravity)
    }

    /// A start at rest: rod after rod turned by the same angle (rad) from its predecessor about its
    /// joint's axis (y for ball joints), the first from straight down.
    pub fn bent(&self, angle: f64) -> Vec<BodyState> {
        let (sin, cos) = (0.5 * angle).sin_cos();
        let mut states = Vec::with_capacity(self.links);
        let mut q = [1.0, 0.0, 0.0, 0.0];
        let mut top = [0.0; 3];
        for k in 0..self.links {
            let is_about_x = self.joint == ChainJoint::Alternating && k % 2 == 0;
            let turn = if is_about_x { [cos, sin, 0.0, 0.0] } else { [cos, 0.0, sin, 0.0] };
            q = surefoot::spatial::Quaternion::from_array(q)
                .product(surefoot::spatial::Quaternion::from_array(turn))
                .to_array();
            let down = surefoot::spatial::Quaternion::from_array(q).rotate(nalgebra::Vector3::new(
                0.0,
                0.0,
                -self.length,
            ));
            let centre: [f64; 3] = std::array::from_fn(|i| top[i] + 0.5 * down[i]);
            states.push([centre[0], centre[1], centre[2], q[0], q[1], q[2], q[3]]);
            top = std::array::from_fn(|i| top[i] + down[i]);
        }
        states
    }
}

//! The block that is thrown at the central body.

use nalgebra::Vector3;
use surefoot_multibody::contact::{Switching, YieldingBox};
use surefoot_multibody::{
    BOX_POINTS, Body, BodyState, CORNERS, Joint, JointConstraint, Link, Striker,
};

/// A free, uniform block, and the box around the central body that it strikes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThrownBlock {
    /// kg
    pub mass: f64,
    /// Edges, m.
    pub size: [f64; 3],
    /// Centre of mass at the start, m, world frame; its edges are along the world's axes there.
    pub position: [f64; 3],
    /// Velocity at the start, m/s, world frame.
    pub velocity: [f64; 3],
    /// The box, in the central body's frame.
    pub around: YieldingBox,
}

/// A thrown block at a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BlockSample {
    /// Centre of mass (m) and orientation (unit quaternion, scalar first), world frame.
    pub pose: [f64; 7],
    /// Force on it of the body that it strikes, N, world frame.
    pub force: [f64; 3],
}

impl ThrownBlock {
    /// Principal inertias, kg·m².
    pub fn inertia(&self) -> [f64; 3] {
        let [x, y, z] = self.size.map(|edge| edge * edge);
        [y + z, x + z, x + y].map(|square| self.mass * square / 12.0)
    }

    /// As a free link.
    pub(super) fn link(&self) -> Link {
        let joint = Joint {
            outboard: [0.0; 3],
            inboard: [0.0; 3],
            home: [1.0, 0.0, 0.0, 0.0],
            constraint: JointConstraint::Floating,
        };
        Link { inboard: None, joint, body: Body { mass: self.mass, inertia: self.inertia() } }
    }

    /// State and rates at the start.
    pub(super) fn start(&self) -> (BodyState, BodyState) {
        let ([x, y, z], [vx, vy, vz]) = (self.position, self.velocity);
        ([x, y, z, 1.0, 0.0, 0.0, 0.0], [vx, vy, vz, 0.0, 0.0, 0.0, 0.0])
    }

    /// What it does as link number `link`, if the central body is number 0.
    pub(super) fn striker(&self, link: usize) -> Striker {
        Striker {
            link,
            points: Striker::box_points(self.size).to_vec(),
            struck: 0,
            around: self.around,
            switching: Switching::WithinTheStep,
        }
    }

    /// Its points that can touch: corners and centres of faces, in its own frame, m.
    pub fn points(&self) -> [Vector3<f64>; BOX_POINTS] {
        Striker::box_points(self.size).map(Vector3::from)
    }

    /// Its corners, in its own frame.
    pub(super) fn corners(&self) -> impl Iterator<Item = [f64; 3]> {
        Striker::box_points(self.size).into_iter().take(CORNERS)
    }
}

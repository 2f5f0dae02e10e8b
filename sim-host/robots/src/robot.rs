//! A robot as the project uses it: bodies on joints that move, with their names.

use crate::description::JointProperties;
use crate::inertial::Inertial;
use nalgebra::{Isometry3, Vector3};

/// A robot: a tree of moving links, inboard ones first.
///
/// Link frames are the file's. What is fixed to a link is part of it and leaves a [`NamedFrame`].
#[derive(Clone, Debug, PartialEq)]
pub struct Robot {
    /// The file's name for it.
    pub name: String,
    /// m/s², world.
    pub gravity: [f64; 3],
    /// Of what is fixed to the world, kg.
    pub fixed_mass: f64,
    /// Moving links.
    pub links: Vec<RobotLink>,
    /// Links of the file that are fixed to others, or to the world.
    pub frames: Vec<NamedFrame>,
    /// Links that stand on the floor.
    pub feet: Vec<Foot>,
}

/// A link with the joint that carries it.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotLink {
    /// Of its own among links and frames.
    pub name: String,
    /// Index of the link that carries it, a smaller one; `None` for the world.
    pub parent: Option<usize>,
    /// What carries it.
    pub joint: RobotJoint,
    /// With all that is fixed to it, in its frame.
    pub inertial: Inertial,
}

/// A joint.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotJoint {
    /// Of its own among joints.
    pub name: String,
    /// How it moves.
    pub motion: RobotMotion,
    /// The link's frame in its parent's (or the world) at coordinate 0.
    pub origin: Isometry3<f64>,
    /// In the link's frame, of unit length.
    pub axis: Vector3<f64>,
    /// A point of the axis in the link's frame, m.
    pub point: Vector3<f64>,
    /// Armature, friction, limits.
    pub properties: JointProperties,
    /// What it follows, if it has no freedom of its own.
    pub follows: Option<Coupling>,
}

/// How a joint moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RobotMotion {
    /// An angle (rad) about the axis.
    Revolute,
    /// The same without end stops.
    Continuous,
    /// A displacement (m) along the axis.
    Prismatic,
    /// Any rotation about the point.
    Spherical,
    /// Anything; the coordinates are the pose of the link's frame in the world.
    Floating,
}

impl RobotMotion {
    /// Velocities.
    pub fn degrees_of_freedom(self) -> usize {
        match self {
            Self::Revolute | Self::Continuous | Self::Prismatic => 1,
            Self::Spherical => 3,
            Self::Floating => 6,
        }
    }

    /// Whether it has one coordinate and an axis.
    pub fn has_axis(self) -> bool {
        self.degrees_of_freedom() == 1
    }
}

/// q = multiplier · q(leader) + offset
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coupling {
    /// Index of the link whose joint leads.
    pub leader: usize,
    /// Its factor.
    pub multiplier: f64,
    /// rad, or m.
    pub offset: f64,
}

/// A frame that is fixed to a link.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedFrame {
    /// Of its own among links and frames.
    pub name: String,
    /// Index of the link; `None` for the world.
    pub link: Option<usize>,
    /// In the link's frame, or the world.
    pub pose: Isometry3<f64>,
    /// Whether nothing hangs from it in the file.
    pub is_leaf: bool,
}

/// Where a robot touches the floor.
#[derive(Clone, Debug, PartialEq)]
pub struct Foot {
    /// The file's link.
    pub name: String,
    /// Index of the moving link that it is part of.
    pub link: usize,
    /// In that link's frame, m.
    pub points: Vec<Vector3<f64>>,
}

impl RobotJoint {
    /// The link's frame in its parent's with the joint at `q`; of a joint with an axis.
    pub fn pose_at(&self, q: f64) -> Isometry3<f64> {
        self.origin * displacement(self.motion, &self.axis, &self.point, q)
    }
}

/// What a joint with an axis does to the frame of its link.
pub(crate) fn displacement(
    motion: RobotMotion,
    axis: &Vector3<f64>,
    point: &Vector3<f64>,
    q: f64,
) -> Isometry3<f64> {
    if motion == RobotMotion::Prismatic {
        return Isometry3::translation(axis.x * q, axis.y * q, axis.z * q);
    }
    let rotation = nalgebra::UnitQuaternion::from_scaled_axis(axis * q);
    let shift = point - rotation * point;
    Isometry3::from_parts(shift.into(), rotation)
}

impl Robot {
    /// Of all that moves, kg.
    pub fn mass(&self) -> f64 {
        self.links.iter().fold(0.0, |sum, link| sum + link.inertial.mass)
    }

    /// Velocities of all joints, those that follow others included.
    pub fn degrees_of_freedom(&self) -> usize {
        self.links.iter().map(|link| link.joint.motion.degrees_of_freedom()).sum()
    }

    /// World from each link's frame with all joints at 0.
    pub fn home_poses(&self) -> Vec<Isometry3<f64>> {
        let mut poses: Vec<Isometry3<f64>> = Vec::with_capacity(self.links.len());
        for link in &self.links {
            let inboard = link.parent.map_or(Isometry3::identity(), |p| poses[p]);
            poses.push(inboard * link.joint.origin);
        }
        poses
    }

    /// Whether nothing hangs from link `k` in the file.
    pub fn is_leaf(&self, k: usize) -> bool {
        self.links.iter().all(|link| link.parent != Some(k))
            && self.frames.iter().all(|frame| frame.link != Some(k))
    }
}

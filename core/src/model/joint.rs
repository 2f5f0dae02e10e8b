//! Joint kinds (§3.2.2).

use super::GeneralJoint;

/// A coordinate axis of a joint frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// (1, 0, 0)
    X,
    /// (0, 1, 0)
    Y,
    /// (0, 0, 1)
    Z,
}

/// How an outboard body moves relative to its inboard one, seen in the joint frame: the frame fixed
/// to the outboard body, at the joint.
#[derive(Clone, Copy, Debug)]
pub enum JointKind {
    /// Not at all. No coordinates.
    Fixed,
    /// It turns about an axis. θ, β: angle (rad) and rate.
    Revolute(Axis),
    /// It slides along an axis. θ, β: displacement (m) and rate.
    Prismatic(Axis),
    /// It turns about a point. θ: unit quaternion, scalar first, inboard from outboard; β: relative
    /// angular velocity in the outboard frame.
    Spherical,
    /// It moves freely. θ: position of the outboard body's frame in the inboard one, then unit
    /// quaternion; β: relative body twist, linear part first.
    Floating,
    /// As the user's function says.
    General(GeneralJoint),
}

impl JointKind {
    /// Number of velocity variables, `d_k`.
    pub const fn degrees_of_freedom(&self) -> usize {
        match self {
            Self::Fixed => 0,
            Self::Revolute(_) | Self::Prismatic(_) => 1,
            Self::Spherical => 3,
            Self::Floating => 6,
            Self::General(joint) => joint.degrees_of_freedom,
        }
    }

    /// Number of configuration variables, `e_k`.
    pub const fn coordinates(&self) -> usize {
        match self {
            Self::Fixed => 0,
            Self::Revolute(_) | Self::Prismatic(_) => 1,
            Self::Spherical => 4,
            Self::Floating => 7,
            Self::General(joint) => joint.coordinates,
        }
    }
}

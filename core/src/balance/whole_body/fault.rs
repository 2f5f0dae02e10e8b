//! Why a tree with feet is no robot that the whole-body controller holds.

/// What is wrong with a tree, its feet, or the settings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WholeBodyRobotFault {
    /// The tree's first body does not float.
    CentralBody,
    /// There is no foot.
    NoFoot,
    /// The joint of this body, which hangs from the central one, is neither revolute nor prismatic.
    Joint {
        /// Index of the body.
        body: usize,
    },
    /// The tree has no such body, or it does not hang from the central one.
    Body {
        /// Number of the foot.
        foot: usize,
        /// Index of the body.
        body: usize,
    },
    /// A number of this foot cannot be: axes that are no unit quaternion, a reference point or limit
    /// that is not finite or negative, or all joints of its leg in the reference point.
    Foot {
        /// Number of the foot.
        foot: usize,
    },
    /// The leg has fewer joints than its contact has directions.
    ShortLeg {
        /// Number of the foot.
        foot: usize,
        /// Joints that are its own.
        joints: usize,
        /// Three for a point, five for an edge, six for a sole.
        directions: usize,
    },
    /// A setting of this joint cannot be: a torque limit that is negative or NaN, a posture that is not
    /// finite.
    Setting {
        /// Index of its velocity.
        velocity: usize,
    },
    /// A gain, rate or weight is negative or not finite.
    Gain,
}

impl core::fmt::Display for WholeBodyRobotFault {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::CentralBody => f.write_str("the first body of a legged robot floats"),
            Self::NoFoot => f.write_str("a legged robot has a foot"),
            Self::Joint { body } => {
                write!(f, "the joint of body {body} is neither revolute nor prismatic")
            }
            Self::Body { foot, body } => {
                write!(f, "foot {foot} is on body {body}, which does not hang from the central one")
            }
            Self::Foot { foot } => {
                write!(f, "a number of foot {foot} is not finite, negative, or no unit quaternion")
            }
            Self::ShortLeg { foot, joints, directions } => write!(
                f,
                "the leg of foot {foot} has {joints} joints of its own for a contact of {directions} directions"
            ),
            Self::Setting { velocity } => {
                write!(f, "the torque limit or posture of velocity {velocity} is no number")
            }
            Self::Gain => f.write_str("a gain, rate or weight is negative or not finite"),
        }
    }
}

impl core::error::Error for WholeBodyRobotFault {}

//! What can be wrong with the input of a dynamics algorithm.

/// Why an algorithm gave no result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DynamicsFault {
    /// Coordinate `index` is NaN or infinite.
    PositionNotFinite {
        /// Index in the array of coordinates.
        index: usize,
    },
    /// The quaternion of joint `joint` is not of unit norm (to 1 in 1000).
    QuaternionNotUnit {
        /// Index of the joint.
        joint: usize,
    },
    /// The inertia seen by joint `joint` is not positive: it has no mass to move, or some input was
    /// NaN or too large.
    SingularInertia {
        /// Index of the joint.
        joint: usize,
    },
    /// Acceleration `index` came out NaN or infinite, because a velocity, torque or wrench was.
    ResultNotFinite {
        /// Index in the array of accelerations.
        index: usize,
    },
}

impl core::fmt::Display for DynamicsFault {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::PositionNotFinite { index } => {
                write!(f, "joint coordinate {index} is not finite")
            }
            Self::QuaternionNotUnit { joint } => {
                write!(f, "the quaternion of joint {joint} is not of unit norm")
            }
            Self::SingularInertia { joint } => {
                write!(f, "the inertia that joint {joint} moves is not positive")
            }
            Self::ResultNotFinite { index } => {
                write!(f, "joint acceleration {index} is not finite")
            }
        }
    }
}

impl core::error::Error for DynamicsFault {}

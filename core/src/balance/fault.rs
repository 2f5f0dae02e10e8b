//! Why a tick gave no torques.

/// Which input was not usable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Input {
    /// Position of the central body.
    Position,
    /// Orientation of the central body.
    Orientation,
    /// Twist of the central body.
    Velocity,
    /// Joint angles of leg number.
    JointAngles(usize),
    /// Joint rates of leg number.
    JointRates(usize),
    /// The reference trajectory.
    Reference,
    /// Coordinate number, of a tree.
    Coordinate(usize),
    /// Velocity number, of a tree.
    Rate(usize),
}

/// What a foot cannot do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum FootLimit {
    /// Pull on the ground, or press with less than the least force asked for.
    Pull,
    /// Hold a tangential force beyond the friction cone.
    Friction,
    /// Have its centre of pressure beyond the sole.
    CenterOfPressure,
}

/// Why [`tick`](super::tick) gave no torques.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Fault {
    /// An input is NaN or infinite.
    NotFinite(Input),
    /// A quaternion is off unit norm by more than 1 in 1000.
    NotUnit(Input),
    /// A leg is at (or nearer than the margin to) a singularity, such as a straight knee: no torque
    /// moves the central body in some direction.
    SingularLeg {
        /// Number of the leg.
        leg: usize,
    },
    /// The articulated inertia lost positive definiteness: the big base's factor is too large for
    /// the precision.
    IndefiniteInertia {
        /// Number of the leg.
        leg: usize,
    },
    /// The wanted motion asks a foot for a wrench that the ground cannot give.
    FootWrench {
        /// Number of the leg.
        leg: usize,
        /// What it would have to do.
        limit: FootLimit,
    },
    /// A torque came out NaN or infinite: an input was finite, but too large.
    Overflow,
    /// No acceleration of the central body follows from wrenches on the feet.
    NotHeld,
}

impl core::fmt::Display for Input {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Position => f.write_str("the central body's position"),
            Self::Orientation => f.write_str("the central body's orientation"),
            Self::Velocity => f.write_str("the central body's velocity"),
            Self::JointAngles(leg) => write!(f, "a joint angle of leg {leg}"),
            Self::JointRates(leg) => write!(f, "a joint rate of leg {leg}"),
            Self::Reference => f.write_str("the reference"),
            Self::Coordinate(k) => write!(f, "coordinate {k}"),
            Self::Rate(k) => write!(f, "velocity {k}"),
        }
    }
}

impl core::fmt::Display for Fault {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::NotFinite(input) => write!(f, "{input} is not finite"),
            Self::NotUnit(input) => write!(f, "{input} is not a unit quaternion"),
            Self::SingularLeg { leg } => write!(f, "leg {leg} is singular (a straight knee?)"),
            Self::IndefiniteInertia { leg } => {
                write!(f, "leg {leg}'s articulated inertia is not positive (big base too big)")
            }
            Self::FootWrench { leg, limit } => {
                let what = match limit {
                    FootLimit::Pull => "pull on the ground",
                    FootLimit::Friction => "push beyond its friction cone",
                    FootLimit::CenterOfPressure => "press beyond the edge of its sole",
                };
                write!(f, "the foot of leg {leg} would have to {what}")
            }
            Self::NotHeld => f.write_str("the feet cannot hold the central body"),
            Self::Overflow => f.write_str("a torque is not finite: some input is too large"),
        }
    }
}

impl core::error::Error for Fault {}

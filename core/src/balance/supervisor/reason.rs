//! Why a robot was stopped.

use crate::balance::{Fault, Input};
use crate::estimate::Concern;

/// Why the supervisor stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum StopReason {
    /// The tick gave a fault.
    Tick(Fault),
    /// No measurement for more ticks in a row than are bridged, or too often: one that repeats the
    /// last to the last bit while it says that joints move is no measurement either.
    Stale,
    /// The tick before took longer than its period.
    Overrun,
    /// An encoder reads what it cannot: angle or rate out of its range, or not finite.
    Encoder {
        /// Number of the leg.
        leg: usize,
        /// Number of the joint, from 0 at the hip.
        joint: usize,
    },
    /// An encoder's angle does not follow its rate, five times in a row.
    Frozen {
        /// Number of the leg.
        leg: usize,
        /// Number of the joint, from 0 at the hip.
        joint: usize,
    },
    /// An encoder's angle is farther from where its rates led it than any impact can put it.
    Jump {
        /// Number of the leg.
        leg: usize,
        /// Number of the joint, from 0 at the hip.
        joint: usize,
    },
    /// The central body's position or orientation is as far from where its velocity led it.
    BodyJump(Input),
    /// Measurements did not fit each other for too many ticks in a row.
    Doubtful,
    /// The central body is tilted too far, or will be.
    Tilt,
    /// The central body has sunk too far, or will have.
    Height,
    /// The central body falls freely: the feet have lost the ground.
    FreeFall,
    /// A motor was at its limit for too long.
    Saturated {
        /// Number of the leg.
        leg: usize,
        /// Number of the joint, from 0 at the hip.
        joint: usize,
    },
    /// The state estimator does not believe itself: what is out of bounds, and stays so.
    Estimate(Concern),
}

impl StopReason {
    /// The joint whose encoder is not to be believed.
    pub(super) fn blamed(&self) -> Option<(usize, usize)> {
        match *self {
            Self::Encoder { leg, joint }
            | Self::Frozen { leg, joint }
            | Self::Jump { leg, joint } => Some((leg, joint)),
            _ => None,
        }
    }
}

impl core::fmt::Display for StopReason {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Tick(fault) => write!(f, "{fault}"),
            Self::Stale => f.write_str("no fresh measurement"),
            Self::Overrun => f.write_str("a tick took longer than its period"),
            Self::Encoder { leg, joint } => {
                write!(f, "the encoder of leg {leg}'s joint {joint} reads out of its range")
            }
            Self::Frozen { leg, joint } => {
                write!(f, "the encoder of leg {leg}'s joint {joint} does not follow its rate")
            }
            Self::Jump { leg, joint } => {
                write!(f, "the encoder of leg {leg}'s joint {joint} jumps")
            }
            Self::BodyJump(input) => write!(f, "{input} jumps"),
            Self::Doubtful => f.write_str("measurements do not fit each other"),
            Self::Tilt => f.write_str("the central body tilts too far"),
            Self::Height => f.write_str("the central body sinks too far"),
            Self::FreeFall => f.write_str("the central body falls freely"),
            Self::Saturated { leg, joint } => {
                write!(f, "the motor of leg {leg}'s joint {joint} is at its limit for too long")
            }
            Self::Estimate(concern) => {
                write!(f, "the state's estimate is not to be believed: out of bounds is {concern}")
            }
        }
    }
}

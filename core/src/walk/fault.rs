//! Why there is no plan.

use super::Side;
use crate::balance::{Fault, Input};

/// What of a plan's input was not usable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WalkInput {
    /// Centre of mass, its velocity, or the angular momentum about it.
    CenterOfMass,
    /// Orientation or angular velocity of the central body.
    CentralBody,
    /// Motion of a foot, by number.
    Foot(usize),
    /// Normal force on a foot, by number.
    Force(usize),
    /// The command.
    Command,
}

/// Why [`Planner::plan`](super::Planner::plan) gave no task. The memory is as it was.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WalkFault {
    /// An input is NaN or infinite.
    NotFinite(WalkInput),
    /// The period is not positive and finite.
    Period,
    /// A number came out NaN or infinite: an input was finite, but too large.
    Overflow,
}

impl From<WalkFault> for Fault {
    /// What a tick says that has no plan.
    fn from(fault: WalkFault) -> Self {
        match fault {
            WalkFault::Overflow => Self::Overflow,
            _ => Self::NotFinite(Input::Reference),
        }
    }
}

/// Why a robot has no [`Stature`](super::Stature).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StatureFault {
    /// No foot is on a side: nothing to step with.
    NoFoot(Side),
    /// More point feet on a side than the two between which a centre of pressure is sought.
    TooManyPoints(Side),
    /// Something measured is not finite.
    NotFinite(WalkInput),
    /// A number that must be positive and finite is not: which of mass, gravity, height, hip height, leg.
    NotPositive(&'static str),
    /// A sole's half length or width is negative, or not finite.
    Sole,
}

impl core::fmt::Display for WalkInput {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::CenterOfMass => f.write_str("the motion of the centre of mass"),
            Self::CentralBody => f.write_str("the central body's rotation"),
            Self::Foot(foot) => write!(f, "the motion of foot {foot}"),
            Self::Force(foot) => write!(f, "the normal force on foot {foot}"),
            Self::Command => f.write_str("the command"),
        }
    }
}

impl core::fmt::Display for WalkFault {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::NotFinite(input) => write!(f, "{input} is not finite"),
            Self::Period => f.write_str("the period is not a positive number of seconds"),
            Self::Overflow => f.write_str("the plan is not finite: some input is too large"),
        }
    }
}

impl core::fmt::Display for StatureFault {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::NoFoot(side) => write!(f, "no foot steps on the {side}, one at least must"),
            Self::TooManyPoints(side) => {
                write!(f, "more than two point feet step together on the {side}")
            }
            Self::NotFinite(input) => write!(f, "{input} is not finite"),
            Self::NotPositive(what) => write!(f, "the {what} is not a positive number"),
            Self::Sole => f.write_str("a sole's half length or width is negative or not finite"),
        }
    }
}

impl core::error::Error for WalkFault {}
impl core::error::Error for StatureFault {}

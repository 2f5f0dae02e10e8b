//! What becomes of a cell.

use crate::stability::loop_limits::Manner;
use serde::{Deserialize, Serialize};
use surefoot_mechanics::forecast::{FailureKind, Verdict};

/// What becomes of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "outcome", content = "how", rename_all = "kebab-case")]
pub enum Outcome {
    /// It works.
    Works,
    /// It fails.
    Fails(Failure),
}

/// How a cell fails.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Failure {
    /// A step, or a motion's energy or constraints.
    Motion(FailureKind),
    /// A control loop.
    Loop(Manner),
}

impl Failure {
    /// For people.
    pub fn words(self) -> &'static str {
        match self {
            Self::Motion(kind) => kind.words(),
            Self::Loop(manner) => manner.words(),
        }
    }

    /// One letter for a cell, unlike those of all others.
    pub fn letter(self) -> &'static str {
        match self {
            Self::Motion(FailureKind::NoRoot) => "N",
            Self::Motion(FailureKind::Singular) => "S",
            Self::Motion(FailureKind::WrongBranch) => "B",
            Self::Motion(FailureKind::Iterations) => "I",
            Self::Motion(FailureKind::NotFinite) => "∞",
            Self::Motion(FailureKind::Tolerance) => "A",
            Self::Motion(FailureKind::Energy) => "E",
            Self::Motion(FailureKind::Constraint) => "C",
            Self::Motion(FailureKind::Runaway) | Self::Loop(Manner::Runaway) => "R",
            Self::Motion(FailureKind::Unbalanced) => "U",
            Self::Loop(Manner::Slip) => "s",
            Self::Loop(Manner::Tip) => "T",
            Self::Loop(Manner::Collapse) => "L",
            Self::Loop(Manner::TorqueLimit) => "Q",
            Self::Loop(Manner::SingularLeg) => "G",
            Self::Loop(Manner::ControllerFault) => "K",
            Self::Loop(Manner::Measurement) => "M",
            Self::Loop(Manner::StepFailure) => "H",
            Self::Loop(Manner::DoesNotSettle) => "D",
            Self::Loop(Manner::NotReachable) => "X",
        }
    }
}

impl From<Verdict> for Outcome {
    fn from(verdict: Verdict) -> Self {
        match verdict {
            Verdict::Works => Self::Works,
            Verdict::Fails { kind, .. } => Self::Fails(Failure::Motion(kind)),
        }
    }
}

impl From<Option<Manner>> for Outcome {
    fn from(manner: Option<Manner>) -> Self {
        manner.map_or(Self::Works, |manner| Self::Fails(Failure::Loop(manner)))
    }
}

//! Whether a motion with one step length works.

use crate::integrators::{Motion, StartError, StepError, StepFailure};
use crate::newton::NewtonFailure;
use serde::{Deserialize, Serialize};
use surefoot::dynamics::DynamicsFault;

/// How a motion ended.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// All steps were made, and energy and constraints stayed within bounds.
    Works,
    /// It failed.
    Fails {
        /// How.
        kind: FailureKind,
        /// When, s.
        time_s: f64,
    },
}

/// How a motion fails.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FailureKind {
    /// The step's equations have no root nearby.
    NoRoot,
    /// The step's equations are singular.
    Singular,
    /// They have a root, but on another branch than that of short steps.
    WrongBranch,
    /// The bound on iterations was met.
    Iterations,
    /// A number was not finite.
    NotFinite,
    /// The adaptive method could not meet its tolerance.
    Tolerance,
    /// Energy left its bounds.
    Energy,
    /// A constraint left its bounds.
    Constraint,
    /// Velocities or torques grew beyond any motion of the robot.
    Runaway,
    /// The robot fell, slid away, or did not come to rest at its set point.
    Unbalanced,
}

impl FailureKind {
    /// For people.
    pub fn words(self) -> &'static str {
        match self {
            Self::NoRoot => "no root",
            Self::Singular => "singular",
            Self::WrongBranch => "wrong branch",
            Self::Iterations => "iterations",
            Self::NotFinite => "not finite",
            Self::Tolerance => "tolerance",
            Self::Energy => "energy",
            Self::Constraint => "constraint",
            Self::Runaway => "runaway",
            Self::Unbalanced => "unbalanced",
        }
    }
}

impl From<StepError> for FailureKind {
    fn from(error: StepError) -> Self {
        match error.failure {
            StepFailure::WrongBranch => Self::WrongBranch,
            StepFailure::TooManySplits { .. } | StepFailure::GimbalLock { .. } => Self::NoRoot,
            StepFailure::Adaptive => Self::Tolerance,
            StepFailure::Dynamics(DynamicsFault::SingularInertia { .. }) => Self::Singular,
            StepFailure::Dynamics(_) => Self::NotFinite,
            StepFailure::Newton(NewtonFailure::NoRootNearby { .. }) => Self::NoRoot,
            StepFailure::Newton(NewtonFailure::SingularJacobian { .. }) => Self::Singular,
            StepFailure::Newton(NewtonFailure::NotFinite) => Self::NotFinite,
            StepFailure::Newton(NewtonFailure::TooManyIterations { .. }) => Self::Iterations,
        }
    }
}

/// What a motion must keep.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    /// Time that it must last, s.
    pub duration_s: f64,
    /// Energy at the start, J.
    pub energy: f64,
    /// How far from that it may be, J.
    pub energy_band: f64,
    /// Whether energy may fall as far as it likes: where the floor or dampers take it.
    pub dissipates: bool,
    /// Size that constraints may have.
    pub constraint: f64,
}

impl Bounds {
    /// Whether energy that differs by so much from that of the start is out of bounds.
    pub fn is_off(&self, by: f64) -> bool {
        let beyond = if self.dissipates { by } else { by.abs() };
        !(beyond <= self.energy_band)
    }
}

/// Makes a motion and judges it. `None` where the method is not made for the system.
pub fn attempt<const N: usize>(
    start: Result<Motion<N>, StartError>,
    bounds: &Bounds,
    energy: impl Fn(&[f64; N], &[f64; N]) -> f64,
    constraint: impl Fn(&[f64; N]) -> f64,
) -> Option<Verdict> {
    let mut motion = match start {
        Ok(motion) => motion,
        Err(StartError::FirstStep(error)) => {
            return Some(Verdict::Fails { kind: error.into(), time_s: 0.0 });
        }
        Err(_) => return None,
    };
    let fails = |kind: FailureKind, time_s: f64| Some(Verdict::Fails { kind, time_s });
    let steps = (bounds.duration_s / motion.progress().h).ceil() as u64;
    for _ in 0..steps {
        if let Err(error) = motion.step() {
            return fails(error.into(), error.time_s);
        }
        let time_s = motion.progress().time_s;
        let velocity = match motion.velocity() {
            Ok(velocity) => velocity,
            Err(error) => return fails(error.into(), time_s),
        };
        let off = energy(motion.configuration(), &velocity) - bounds.energy;
        let apart = constraint(motion.configuration());
        if !(off.is_finite() && apart.is_finite()) {
            return fails(FailureKind::NotFinite, time_s);
        }
        if apart > bounds.constraint {
            return fails(FailureKind::Constraint, time_s);
        }
        if bounds.is_off(off) {
            return fails(FailureKind::Energy, time_s);
        }
    }
    Some(Verdict::Works)
}

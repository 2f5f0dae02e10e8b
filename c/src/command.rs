//! What a tick gives.

use crate::robot::{LEG, SUREFOOT_JOINTS};
use surefoot::balance::{ContactLimit, LimitReport, Mode, StopReason};
use surefoot::qp::Status;

/// What the supervisor is doing.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SurefootMode {
    /// Not asked to do anything: zero torques.
    Standby = 0,
    /// Balancing.
    Active = 1,
    /// Motors brake.
    Stopping = 2,
    /// Stopped for a reason: zero torques until armed again.
    Stopped = 3,
}

/// Why the supervisor has stopped the robot.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SurefootStop {
    /// It has not.
    None = 0,
    /// The controller had no answer: an input is no number, or a leg is singular.
    Fault = 1,
    /// No fresh measurement for too long, or too often.
    Stale = 2,
    /// A tick took longer than its period.
    Overrun = 3,
    /// An encoder reads out of its range.
    Encoder = 4,
    /// An encoder does not follow its rate.
    Frozen = 5,
    /// An encoder jumps.
    Jump = 6,
    /// The central body's pose jumps.
    BodyJump = 7,
    /// Measurements do not fit each other.
    Doubtful = 8,
    /// The central body tilts too far.
    Tilt = 9,
    /// The central body sinks too far.
    Height = 10,
    /// The central body falls freely.
    FreeFall = 11,
    /// A motor was at its limit for too long.
    Saturated = 12,
    /// The state's estimate is not to be believed.
    Estimate = 13,
}

/// A limit of ground or motors.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SurefootLimit {
    /// None binds.
    None = 0,
    /// Least force on a foot.
    Lift = 1,
    /// Greatest force on a foot.
    Press = 2,
    /// Friction against sliding.
    Slip = 3,
    /// Centre of pressure at the sole's edge.
    Tip = 4,
    /// Friction against turning about the normal.
    Twist = 5,
    /// Torque of a joint.
    Torque = 6,
}

/// What a tick gives. A joint or leg that is of no meaning is 255.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurefootCommand {
    /// For the motors, N·m, finite and within the robot's limits in every mode.
    pub torques: [f32; SUREFOOT_JOINTS],
    /// After the tick.
    pub mode: SurefootMode,
    /// Why it was stopped.
    pub stop: SurefootStop,
    /// The joint that the reason names, in the order of torques.
    pub stop_joint: u8,
    /// The limit of ground or motors that costs most, if limits are looked at.
    pub limit: SurefootLimit,
    /// Its leg.
    pub limit_leg: u8,
    /// Its joint, in the order of torques.
    pub limit_joint: u8,
    /// By how much the objective would fall per 100 % of a wider limit.
    pub limit_relief: f32,
    /// Whether the tick's work was spent before all limits were kept; torques are cut in any case.
    pub is_unfinished: bool,
    /// How often torques were cut so far.
    pub cut_torques: u32,
}

/// No joint or leg.
const NONE: u8 = u8::MAX;

impl SurefootCommand {
    /// Zero torques in standby.
    pub(crate) const NOTHING: Self = Self {
        torques: [0.0; SUREFOOT_JOINTS],
        mode: SurefootMode::Standby,
        stop: SurefootStop::None,
        stop_joint: NONE,
        limit: SurefootLimit::None,
        limit_leg: NONE,
        limit_joint: NONE,
        limit_relief: 0.0,
        is_unfinished: false,
        cut_torques: 0,
    };

    /// Tells what the supervisor does.
    pub(crate) fn tell_mode(&mut self, mode: Mode, reason: Option<StopReason>) {
        self.mode = match mode {
            Mode::Standby => SurefootMode::Standby,
            Mode::Active => SurefootMode::Active,
            Mode::Stopping { .. } => SurefootMode::Stopping,
            Mode::Stopped => SurefootMode::Stopped,
        };
        let Some(reason) = reason else { return };
        self.stop = match reason {
            StopReason::Tick(_) => SurefootStop::Fault,
            StopReason::Stale => SurefootStop::Stale,
            StopReason::Overrun => SurefootStop::Overrun,
            StopReason::Encoder { .. } => SurefootStop::Encoder,
            StopReason::Frozen { .. } => SurefootStop::Frozen,
            StopReason::Jump { .. } => SurefootStop::Jump,
            StopReason::BodyJump(_) => SurefootStop::BodyJump,
            StopReason::Doubtful => SurefootStop::Doubtful,
            StopReason::Tilt => SurefootStop::Tilt,
            StopReason::Height => SurefootStop::Height,
            StopReason::FreeFall => SurefootStop::FreeFall,
            StopReason::Saturated { .. } => SurefootStop::Saturated,
            StopReason::Estimate(_) => SurefootStop::Estimate,
        };
        if let StopReason::Encoder { leg, joint }
        | StopReason::Frozen { leg, joint }
        | StopReason::Jump { leg, joint }
        | StopReason::Saturated { leg, joint } = reason
        {
            self.stop_joint = number(leg, joint);
        }
    }

    /// Tells what limits made of the tick.
    pub(crate) fn tell_limits<const LEGS: usize>(&mut self, report: &LimitReport<f32, LEGS>) {
        self.is_unfinished = matches!(report.status, Status::BudgetSpent | Status::TooManyRows);
        let Some(worst) = report.worst else { return };
        self.limit = match worst.limit {
            ContactLimit::Lift => SurefootLimit::Lift,
            ContactLimit::Press => SurefootLimit::Press,
            ContactLimit::Slip => SurefootLimit::Slip,
            ContactLimit::Tip => SurefootLimit::Tip,
            ContactLimit::Twist => SurefootLimit::Twist,
            // Its controller knows no ranges.
            ContactLimit::Torque(_) | ContactLimit::Range(_) => SurefootLimit::Torque,
        };
        self.limit_leg = u8::try_from(worst.foot).unwrap_or(NONE);
        if let ContactLimit::Torque(joint) = worst.limit {
            self.limit_joint = number(worst.foot, usize::from(joint));
        }
        self.limit_relief = worst.relief;
    }
}

/// A leg's joint in the order of torques.
fn number(leg: usize, joint: usize) -> u8 {
    u8::try_from(leg.saturating_mul(LEG).saturating_add(joint)).unwrap_or(NONE)
}

//! Limits of ground and motors for the ticks of a target, and what became of them.

use crate::joints::Joints;
use heapless::Vec;
use serde::{Deserialize, Serialize};
use surefoot::Real;
use surefoot::balance::{
    ContactLimit, Ground, LimitReport, Reason, Sole, WholeBodyLimit, WholeBodyReport,
};
use surefoot::qp;

/// Most feet of a robot: contacts are bits of a byte.
pub const MOST_FEET: usize = 8;

/// What the ground and the motors give; wrenches are distributed within it. No more than the target's
/// own robot has: soles within its soles, torques within its limits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WrenchSettings<const JOINTS: usize> {
    /// Of the floor under every foot.
    pub ground: Ground<f32>,
    /// Of the feet, in the robot's order: origin at the last joint, axes as the robot is described with
    /// all joints at 0, m.
    pub soles: Vec<Sole<f32>, MOST_FEET>,
    /// Greatest torques, N·m.
    pub torques: Joints<f32, JOINTS>,
}

/// How a robot stands that the whole-body controller balances: what its gains, its posture and its limits
/// follow from. No more torque than the target's own robot has.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StanceSettings<const JOINTS: usize> {
    /// Of the floor under every foot.
    pub ground: Ground<f32>,
    /// Of the central body above its feet, m.
    pub height: f32,
    /// m/s²
    pub gravity: f32,
    /// Greatest torques, N·m.
    pub torques: Joints<f32, JOINTS>,
    /// Angles that limbs track, rad.
    pub posture: Joints<f32, JOINTS>,
}

/// What limits made of a tick.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TickLimits<T> {
    /// Whether some limit bound.
    pub is_active: bool,
    /// Whether the tick's work was spent before the answer was reached.
    pub is_unfinished: bool,
    /// The limit that cost most. Torques are numbered by rows of six joints in the robot's order: on legs of
    /// six joints the row is the leg.
    pub worst: Option<Reason<T>>,
}

impl<T: Real, const LEGS: usize> From<&LimitReport<T, LEGS>> for TickLimits<T> {
    fn from(report: &LimitReport<T, LEGS>) -> Self {
        Self {
            is_active: report.is_limited(),
            is_unfinished: is_unfinished(report.status),
            worst: report.worst,
        }
    }
}

impl<T: Real, const FEET: usize> From<&WholeBodyReport<T, FEET>> for TickLimits<T> {
    fn from(report: &WholeBodyReport<T, FEET>) -> Self {
        let worst = report.worst.map(|(limit, relief)| match limit {
            WholeBodyLimit::Foot { foot, limit } => Reason { foot, limit, relief },
            WholeBodyLimit::Torque { velocity } => {
                let joint = velocity.saturating_sub(6);
                Reason { foot: joint / 6, limit: ContactLimit::Torque((joint % 6) as u8), relief }
            }
            WholeBodyLimit::Range { velocity } => {
                let joint = velocity.saturating_sub(6);
                Reason { foot: joint / 6, limit: ContactLimit::Range((joint % 6) as u8), relief }
            }
        });
        let is_unfinished = is_unfinished(report.status);
        Self { is_active: report.is_limited(), is_unfinished, worst }
    }
}

/// Whether the tick's work was spent before the answer was reached.
fn is_unfinished(status: qp::Status) -> bool {
    matches!(status, qp::Status::BudgetSpent | qp::Status::TooManyRows)
}

//! Limits of ground and motors for the ticks of a target, and what became of them.

use crate::numbers;
use heapless::Vec;
use serde::{Deserialize, Serialize};
use surefoot::Real;
use surefoot::balance::{Ground, LimitReport, Reason, Sole};
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
    #[serde(with = "numbers")]
    pub torques: [f32; JOINTS],
}

/// What limits made of a tick.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TickLimits<T> {
    /// Whether some limit bound.
    pub is_active: bool,
    /// Whether the tick's work was spent before the answer was reached.
    pub is_unfinished: bool,
    /// The limit that cost most.
    pub worst: Option<Reason<T>>,
}

impl<T: Real, const LEGS: usize> From<&LimitReport<T, LEGS>> for TickLimits<T> {
    fn from(report: &LimitReport<T, LEGS>) -> Self {
        let spent = [qp::Status::BudgetSpent, qp::Status::TooManyRows];
        Self {
            is_active: report.is_limited(),
            is_unfinished: spent.contains(&report.status),
            worst: report.worst,
        }
    }
}

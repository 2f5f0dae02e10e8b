//! Which robot an end of the link has been built for.

use serde::{Deserialize, Serialize};
use surefoot::balance::{LeggedRobot, SafetyLimits, WholeBodyFoot, whole_body_fingerprint};
use surefoot::model::Tree;

/// Joints of a leg.
const LEG: usize = 6;

/// A robot, told from all others by a few numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct RobotId {
    /// How many joints its messages have.
    pub joints: u8,
    /// Of its numbers, and of its supervisor's limits: [`LeggedRobot::fingerprint`].
    pub fingerprint: u32,
}

impl RobotId {
    /// Of a robot with what its supervisor allows.
    pub const fn of<const LEGS: usize>(
        robot: &LeggedRobot<f32, LEGS>,
        limits: &SafetyLimits<f32, LEGS>,
    ) -> Self {
        Self { joints: (LEG * LEGS) as u8, fingerprint: robot.fingerprint(limits) }
    }

    /// Of the first `bodies` of a tree on its feet, with what its supervisor allows.
    pub const fn of_tree<
        const N: usize,
        const NQ: usize,
        const NV: usize,
        const FEET: usize,
        const ROWS: usize,
    >(
        tree: &Tree<f32, N, NQ, NV>,
        bodies: usize,
        feet: &[Option<WholeBodyFoot<f32>>; FEET],
        limits: &SafetyLimits<f32, ROWS>,
    ) -> Self {
        let fingerprint = whole_body_fingerprint(tree, bodies, feet, limits);
        Self { joints: bodies.saturating_sub(1) as u8, fingerprint }
    }
}

impl core::fmt::Display for RobotId {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "a robot of {} joints with the fingerprint {:08x}", self.joints, self.fingerprint)
    }
}

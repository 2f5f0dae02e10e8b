//! What a robot's firmware is known by.

use super::{LEG, Robot, with_tree};
use surefoot::balance::LeggedRobot;
use surefoot_link::RobotId;

impl Robot {
    /// Of its numbers in single precision, and of its supervisor's limits.
    pub fn id(&self) -> RobotId {
        with_tree!(&self.tree, tree, LEGS => {
            let robot = LeggedRobot::<f64, LEGS>::new(tree).to_f32();
            match self.limits.sized::<LEGS>() {
                Some(limits) => RobotId::of(&robot, &limits.to_f32()),
                // Robots of files have them all.
                None => RobotId { joints: (LEG * LEGS) as u8, fingerprint: 0 },
            }
        })
    }
}

//! What a robot's firmware is known by.

use super::{Robot, with_tree};
use surefoot::balance::LeggedRobot;
use surefoot_link::RobotId;

impl Robot {
    /// Of its numbers in single precision, and of its supervisor's limits; `None` of a robot that is not on legs of six
    /// joints alone, which no firmware balances yet.
    pub fn id(&self) -> Option<RobotId> {
        with_tree!(&self.tree, tree, LEGS => {
            let robot = LeggedRobot::<f64, LEGS>::new(tree).to_f32();
            let limits = self.limits.sized::<LEGS>()?;
            Some(RobotId::of(&robot, &limits.to_f32()))
        }, _tree, _ROWS => None)
    }
}

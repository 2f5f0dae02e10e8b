//! What a robot's firmware is known by.

use super::{Robot, with_tree};
use surefoot::balance::{LeggedRobot, WholeBodyFoot};
use surefoot_link::RobotId;

impl Robot {
    /// Of its numbers in single precision, of its feet as the whole-body controller takes them where it has
    /// that one, and of its supervisor's limits; `None` of a robot that lacks limits for its joints.
    pub(crate) fn id_on(
        &self,
        feet: impl Fn() -> [Option<WholeBodyFoot<f32>>; 4],
    ) -> Option<RobotId> {
        with_tree!(&self.tree, tree, LEGS => {
            let robot = LeggedRobot::<f64, LEGS>::new(tree).to_f32();
            let limits = self.limits.sized::<LEGS>()?;
            Some(RobotId::of(&robot, &limits.to_f32()))
        }, tree, ROWS => {
            let limits = self.limits.in_rows::<ROWS>()?;
            let bodies = self.tree.bodies();
            Some(RobotId::of_tree(&tree.to_f32(), bodies, &feet(), &limits.to_f32()))
        })
    }
}

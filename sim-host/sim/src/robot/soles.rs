//! Soles: what the points of a flat foot span.

use super::{LEG, Robot};
use crate::plant::PlantState;
use nalgebra::Vector3;
use surefoot::balance::Sole;

/// Points of a sole are level up to this, m.
const LEVEL: f64 = 1e-3;

/// Why a foot has no rectangular sole.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NoSole {
    /// Its points span no area.
    #[error("the points of {0} span no area")]
    NoArea(String),
    /// They do not lie in one plane when all joints are at 0.
    #[error("the points of {0} are not level with all joints at 0")]
    NotLevel(String),
}

impl Robot {
    /// The rectangles that the feet's points span: origin at a leg's last joint, axes as the robot is described with
    /// all joints at 0, m.
    ///
    /// # Errors
    /// A [`NoSole`] for the first foot that has none.
    pub fn soles(&self) -> Result<Vec<Sole<f64>>, NoSole> {
        let home = PlantState::home(self.joint_count());
        let poses = self.tree.body_poses(&home.positions).unwrap_or_default();
        self.feet
            .iter()
            .enumerate()
            .map(|(leg, foot)| {
                let no_area = || NoSole::NoArea(foot.name.clone());
                let pose = poses.get(foot.body).ok_or_else(no_area)?;
                let shape = self.tree.body_shape(LEG * (leg + 1)).ok_or_else(no_area)?;
                let from_joint = |at: Vector3<f64>| pose.rotation * (at - shape.joint);
                let points: Vec<_> = foot.points.iter().map(|point| from_joint(point.at)).collect();
                let range = |k: usize| {
                    points.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], p| {
                        [least.min(p[k]), most.max(p[k])]
                    })
                };
                let ([x, y, z], wide) = ([0, 1, 2].map(range), |[a, b]: [f64; 2]| b - a > LEVEL);
                if !(wide(x) && wide(y)) {
                    return Err(no_area());
                }
                if wide(z) {
                    return Err(NoSole::NotLevel(foot.name.clone()));
                }
                Ok(Sole { x, y, z: 0.5 * (z[0] + z[1]) })
            })
            .collect()
    }
}

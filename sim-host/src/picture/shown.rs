//! What there is to see of a scene.

use super::Solid;
use crate::robot::SharedRobot;
use crate::scene::{Feet, Scene, SetPoint};

/// Length of an arrow for a force of the ground or the block, m/N.
pub const FORCE_LENGTH: f64 = 1e-3;

/// Length of an arrow for the desired force, which is that of all corners together, m/N.
pub const DESIRED_FORCE_LENGTH: f64 = 4e-4;

/// Length of an arrow for the desired torque, m/(N·m).
pub const TORQUE_LENGTH: f64 = 6e-3;

/// What there is to see of a scene, besides what moves.
#[derive(Clone, Debug)]
pub struct Shown {
    /// The robot.
    pub robot: SharedRobot,
    /// Whether its feet touch a floor, and are not held.
    pub has_contacts: bool,
    /// The thrown block, in its frame.
    pub block: Option<Solid>,
    /// Where the central body should be.
    pub set_point: SetPoint,
}

impl Shown {
    /// Of a scene.
    pub fn of(scene: &Scene) -> Self {
        Self {
            robot: scene.robot(),
            has_contacts: matches!(scene.feet, Feet::Floor { .. }),
            block: scene.block.map(|block| Solid::cuboid(block.size_m)),
            set_point: scene.set_point,
        }
    }
}

//! What there is to see of a scene.

use super::{Solid, robot_solids};
use crate::scene::{Feet, Scene, SetPoint};
use nalgebra::Vector3;
use surefoot::model::robots::biped::SoleOutline;

/// Length of an arrow for a force of the ground or the block, m/N.
pub const FORCE_LENGTH: f64 = 1e-3;

/// Length of an arrow for the desired force, which is that of all corners together, m/N.
pub const DESIRED_FORCE_LENGTH: f64 = 4e-4;

/// Length of an arrow for the desired torque, m/(N·m).
pub const TORQUE_LENGTH: f64 = 6e-3;

/// What there is to see of a scene, besides what moves.
#[derive(Clone, Debug)]
pub struct Shown {
    /// A solid for each body.
    pub solids: [Solid; 13],
    /// Corners of a sole in its foot's frame, m; `None` where the feet are held.
    pub corners: Option<[Vector3<f64>; 4]>,
    /// The thrown block, in its frame.
    pub block: Option<Solid>,
    /// Where the central body should be.
    pub set_point: SetPoint,
}

impl Shown {
    /// Of a scene.
    pub fn of(scene: &Scene) -> Self {
        let (sole, corners) = match scene.feet {
            Feet::Floor { outline, .. } => (outline.sole(), Some(outline.sole().corners())),
            Feet::Welded {} => (SoleOutline::A, None),
        };
        Self {
            solids: robot_solids(&sole),
            corners,
            block: scene.block.map(|block| Solid::cuboid(block.size_m)),
            set_point: scene.set_point,
        }
    }
}

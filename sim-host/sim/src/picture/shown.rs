//! What there is to see of a scene, and at an instant of its run.

use super::Solid;
use crate::plant::BlockSample;
use crate::scene::{Feet, Scene};
use nalgebra::Vector3;
use serde::Serialize;
use surefoot::spatial::{Pose, Quaternion};
use surefoot_multibody::contact::ContactState;

/// Length of an arrow for a force of the ground or the block on a robot, m/N.
pub const FORCE_LENGTH: f64 = 1e-3;

/// Length of an arrow for the desired force, which is that of all corners together, m/N.
pub const DESIRED_FORCE_LENGTH: f64 = 4e-4;

/// Length of an arrow for the desired torque, m/(N·m).
pub const TORQUE_LENGTH: f64 = 6e-3;

/// What there is to see of a scene, whatever moves in it.
#[derive(Clone, Debug)]
pub struct Shown {
    /// What moves.
    pub bodies: Vec<ShownBody>,
    /// Points that can touch the floor.
    pub points: Vec<ShownPoint>,
    /// What stands in the world for the eye: joints that hold bodies to it.
    pub pivots: Vec<Solid>,
    /// A thrown block, in its frame.
    pub block: Option<Solid>,
    /// Where the first body should be, in the world.
    pub goal: Option<Solid>,
    /// What colours mean, by group.
    pub legend: Vec<(u8, String)>,
    /// Length of an arrow for a force of the floor, m/N.
    pub force_length: f64,
    /// From where it is looked at.
    pub framing: Framing,
}

/// A body.
#[derive(Clone, Debug)]
pub struct ShownBody {
    /// Name, for people.
    pub name: String,
    /// Which colour it has: 0 blue, 1 orange, 2 green.
    pub group: u8,
    /// What it looks like, in its frame.
    pub solids: Vec<Solid>,
}

/// A point that can touch the floor.
#[derive(Clone, Copy, Debug)]
pub struct ShownPoint {
    /// Its body.
    pub body: usize,
    /// In the body's frame, m.
    pub at: Vector3<f64>,
}

/// From where a run is looked at.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Framing {
    /// What is in the middle, m; `None` along axes on which it goes with what moves.
    pub target: [Option<f64>; 3],
    /// The body that it goes with; `None` for the mean of all.
    pub follows: Option<usize>,
    /// Of the eye from it, m.
    pub distance: f64,
    /// Edge of the squares on the ground, m.
    pub square: f64,
    /// Height of the ground that is drawn, m; `None` for one that goes with what moves.
    pub ground: Option<f64>,
}

/// What there is to see at an instant.
#[derive(Clone, Debug)]
pub struct Moment {
    /// Of all bodies.
    pub poses: Vec<Pose<f64>>,
    /// States of the points that can touch the floor; none where that is not known.
    pub contacts: Vec<ContactState>,
    /// Forces of the floor on them, N, world frame; likewise.
    pub forces: Vec<[f64; 3]>,
    /// The thrown block.
    pub block: Option<BlockSample>,
    /// What a controller asks for, and how far from it the first body is.
    pub tracking: Option<Tracking>,
}

/// What a controller asks for, and how far from it the first body is.
#[derive(Clone, Copy, Debug)]
pub struct Tracking {
    /// On the first body, in its frame: N, N·m.
    pub desired_wrench: [f64; 6],
    /// m
    pub distance: f64,
    /// rad
    pub angle: f64,
}

impl Shown {
    /// Of a robot's scene.
    pub fn of(scene: &Scene) -> Self {
        let robot = scene.robot();
        let group = |k: usize| robot.leg_of(k).map_or(0, |leg| 1 + (leg % 2) as u8);
        let bodies = robot.bodies.iter().zip(&robot.shapes).enumerate();
        let on_floor = matches!(scene.feet, Feet::Floor { .. });
        let feet = robot.feet.iter().filter(|_| on_floor);
        let rotation = Quaternion::from_array(scene.set_point.orientation).to_matrix();
        let goal =
            |shape: &Solid| shape.clone().moved(&rotation, scene.set_point.position_m.into());
        Self {
            bodies: bodies
                .map(|(k, (name, solid))| ShownBody {
                    name: name.clone(),
                    group: group(k),
                    solids: vec![solid.clone()],
                })
                .collect(),
            points: feet
                .flat_map(|foot| {
                    foot.points.iter().map(|point| ShownPoint { body: foot.body, at: point.at })
                })
                .collect(),
            pivots: Vec::new(),
            block: scene.block.map(|block| Solid::cuboid(block.size_m)),
            goal: robot.shapes.first().map(goal),
            legend: vec![(1, "left leg".to_owned()), (2, "right leg".to_owned())],
            force_length: FORCE_LENGTH,
            framing: Framing::OF_A_PERSON,
        }
    }
}

impl Framing {
    /// Of a robot as large as a person.
    pub const OF_A_PERSON: Self = Self {
        target: [None, None, Some(0.78)],
        follows: Some(0),
        distance: 3.3,
        square: 0.2,
        ground: Some(0.0),
    };
}

//! What a robot that walks is told: its measures once, and what it is to do.

use crate::limits::MOST_FEET;
use heapless::Vec;
use nalgebra::Vector2;
use serde::{Deserialize, Serialize};
use surefoot::walk::{
    JumpOrder, PlaneMotion, Side, StandingRobot, Stature, SteppingFoot, WalkCommand,
};

/// A robot's [`Stature`], and where it begins.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WalkerSettings {
    /// kg, m/s², and the length of a straight leg, m.
    pub mass_gravity_leg: [f32; 3],
    /// Yaw of forward from the central body's first axis, rad.
    pub forward: f32,
    /// Half of a sole, and how far in it pressure can be shifted, m.
    pub sole: [[f32; 2]; 2],
    /// Heights of the centre of mass and of the hips, and the feet's distance, m.
    pub height_hips_width: [f32; 3],
    /// By foot; none where the robot has none.
    pub feet: Vec<Option<WalkerFoot>, MOST_FEET>,
    /// Yaw of the central body at the start, rad.
    pub heading: f32,
}

/// A foot that steps.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct WalkerFoot {
    /// Whether it steps with the left side.
    pub is_left: bool,
    /// From the mean point of its side, forward and left, m.
    pub offset: [f32; 2],
    /// Of its sole from the central body, rad.
    pub yaw: f32,
}

/// What a robot is to do from the next tick on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct WalkOrder {
    /// Forward and to the left, m/s, and turning to the left, rad/s; none: it stands, as soon as it can.
    pub motion: Option<[f32; 3]>,
    /// Whether it runs instead of walking.
    pub runs: bool,
    /// A jump when it stands: by how much the centre of mass is to rise, m, how often, and the order's number.
    pub jump: Option<(f32, u8, u8)>,
    /// How far below its standing height, m.
    pub lowered: f32,
}

impl WalkerSettings {
    /// Of a robot's measures.
    pub fn of<const FEET: usize>(stature: &Stature<f32, FEET>, heading: f32) -> Self {
        let robot = &stature.robot;
        let pair = |v: &Vector2<f32>| [v.x, v.y];
        let foot = |foot: &SteppingFoot<f32>| WalkerFoot {
            is_left: foot.side == Side::Left,
            offset: pair(&foot.offset),
            yaw: foot.yaw,
        };
        Self {
            mass_gravity_leg: [robot.mass, robot.gravity, robot.leg_length],
            forward: robot.forward,
            sole: [pair(&robot.sole), pair(&robot.pressure_reach)],
            height_hips_width: [stature.height, stature.hip_height, stature.width],
            feet: stature.feet.iter().take(MOST_FEET).map(|f| f.as_ref().map(foot)).collect(),
            heading,
        }
    }

    /// The measures; a gait's check refuses those that cannot be.
    pub fn stature<const FEET: usize>(&self) -> Stature<f32, FEET> {
        let [mass, gravity, leg_length] = self.mass_gravity_leg;
        let [height, hip_height, width] = self.height_hips_width;
        let [sole, pressure_reach] = self.sole.map(Vector2::from);
        let foot = |foot: &WalkerFoot| SteppingFoot {
            side: if foot.is_left { Side::Left } else { Side::Right },
            offset: foot.offset.into(),
            yaw: foot.yaw,
        };
        let robot = StandingRobot {
            mass,
            gravity,
            leg_length,
            forward: self.forward,
            sole,
            pressure_reach,
        };
        let feet = core::array::from_fn(|k| self.feet.get(k)?.as_ref().map(foot));
        Stature { robot, height, hip_height, width, feet }
    }
}

impl From<&WalkOrder> for WalkCommand<f32> {
    fn from(order: &WalkOrder) -> Self {
        let walk = order.motion.map(|[forward, left, turning_rate]| PlaneMotion {
            velocity: Vector2::new(forward, left),
            turning_rate,
        });
        let jump = order.jump.map(|(rise, hops, number)| JumpOrder { rise, hops, number });
        Self { walk, runs: order.runs, jump, lowered: order.lowered }
    }
}

impl From<&WalkCommand<f32>> for WalkOrder {
    fn from(command: &WalkCommand<f32>) -> Self {
        let motion = command.walk.map(|walk| [walk.velocity.x, walk.velocity.y, walk.turning_rate]);
        let jump = command.jump.map(|jump| (jump.rise, jump.hops, jump.number));
        Self { motion, runs: command.runs, jump, lowered: command.lowered }
    }
}

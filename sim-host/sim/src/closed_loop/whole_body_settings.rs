//! How a robot stands that the whole-body controller balances: what host and firmware make their settings of.

use super::limiting::{FRICTION_SHARE, MOST_WEIGHTS, SOLE_SHARE, friction};
use crate::robot::{Contacts, Robot, stance, with_tree};
use crate::scene::{Feet, Scene};
use surefoot::Real;
use surefoot::balance::{ContactLimits, Ground, LeggedRobot, WholeBodyFoot, WholeBodySettings};
use surefoot::spatial::Quaternion;
use surefoot_link::RobotId;

/// Feet that the controller has room for.
pub(super) const FEET: usize = 4;
/// A foot that stands is pressed on with this share of the robot's weight.
const LEAST_SHARE: f64 = 0.007;

/// In a scene.
pub(super) struct Standing {
    /// Of the central body above its feet, m.
    pub height: f64,
    /// m/s²
    pub gravity: f64,
    /// Of the floor under each foot.
    pub ground: Ground<f64>,
    /// Greatest, joint by joint, N·m.
    pub torques: Vec<f64>,
    /// Angles that limbs track, rad.
    pub posture: Vec<f64>,
}

impl Standing {
    /// At a scene's start, within what its floor and motors can give.
    pub fn of(scene: &Scene) -> Self {
        let robot = scene.robot();
        let posture = scene.initial.state().positions[7..].to_vec();
        let height = stance::on_floor(&robot, &posture, Quaternion::identity()).positions[2];
        let gravity = robot.tree.gravity().norm();
        let weight = robot.tree.mass() * gravity;
        let friction = match &scene.feet {
            Feet::Floor { floor, .. } => friction(floor),
            Feet::Welded {} => 1.0,
        };
        let ground = Ground {
            least_force: LEAST_SHARE * weight,
            greatest_force: MOST_WEIGHTS * weight,
            friction: FRICTION_SHARE * friction,
        };
        let torques = robot.limits.joints.iter().map(|limits| limits.torque).collect();
        Self { height, gravity, ground, torques, posture }
    }

    /// Without the scene's gains.
    pub fn settings<T: Real, const NV: usize>(&self) -> WholeBodySettings<T, NV> {
        let mut settings =
            WholeBodySettings::<T, NV>::scaled(T::of(self.height), T::of(self.gravity), FEET);
        for (to, torque) in settings.torques.iter_mut().skip(6).zip(&self.torques) {
            *to = T::of(*torque);
        }
        for (to, angle) in settings.posture.iter_mut().skip(6).zip(&self.posture) {
            *to = T::of(*angle);
        }
        settings
    }

    /// A robot's feet on the ground.
    pub fn feet<T: Real>(&self, robot: &Robot) -> [Option<WholeBodyFoot<T>>; FEET] {
        let ground = &self.ground;
        feet(robot).map(|foot| {
            foot.map(|foot| WholeBodyFoot {
                limits: ContactLimits {
                    least_force: T::of(ground.least_force),
                    greatest_force: T::of(ground.greatest_force),
                    friction: T::of(ground.friction),
                    ..foot.limits
                },
                ..foot
            })
        })
    }
}

impl Robot {
    /// What its firmware is known by, of a robot that stands; `None` of a robot that lacks limits for its joints.
    pub fn id(&self) -> Option<RobotId> {
        if self.tree.is_six_jointed() { legs_id(self) } else { tree_id(self) }
    }
}

/// What the firmware of a scene's robot is known by.
pub(super) fn firmware_id(scene: &Scene) -> Option<RobotId> {
    let robot = scene.robot();
    if scene.walk.is_empty() { robot.id() } else { tree_id(&robot) }
}

/// On legs of six joints: of its numbers in single precision, and of its supervisor's limits.
pub(super) fn legs_id(robot: &Robot) -> Option<RobotId> {
    with_tree!(&robot.tree, tree, LEGS => {
        let limits = robot.limits.sized::<LEGS>()?;
        Some(RobotId::of(&LeggedRobot::<f64, LEGS>::new(tree).to_f32(), &limits.to_f32()))
    }, _tree, _ROWS => None)
}

/// As the whole-body controller takes it: of its feet too.
pub(super) fn tree_id(robot: &Robot) -> Option<RobotId> {
    with_tree!(&robot.tree, tree, ROWS => {
        let limits = robot.limits.in_rows::<ROWS>()?.to_f32();
        Some(RobotId::of_tree(&tree.to_f32(), robot.tree.bodies(), &feet(robot), &limits))
    }, tree, ROWS => {
        let limits = robot.limits.in_rows::<ROWS>()?.to_f32();
        Some(RobotId::of_tree(&tree.to_f32(), robot.tree.bodies(), &feet(robot), &limits))
    })
}

/// A robot's feet, with as much of their soles as is counted on, before it is known what they stand on.
///
/// # Panics
/// For a robot without feet on legs.
pub(super) fn feet<T: Real>(robot: &Robot) -> [Option<WholeBodyFoot<T>>; FEET] {
    let contacts = Contacts::of(robot).expect("a robot with feet on legs");
    contacts.feet.map(|foot| {
        foot.map(|foot| {
            let limits = ContactLimits {
                least_force: 0.0,
                greatest_force: 0.0,
                friction: 0.0,
                patch: foot.limits.patch.shrunk(SOLE_SHARE),
                torques: [],
            };
            WholeBodyFoot { limits, ..foot }.rounded()
        })
    })
}

//! The robot of a scene: its tree, its names, where it stands on the floor, what it looks like, what it may.
//!
//! Sizes are known when the program runs. Core's algorithms are compiled for some of them, which [`SizedTree`] alone
//! tells apart.

mod bent_legs;
mod biped;
mod contacts;
mod from_file;
mod limits;
mod sized_tree;
mod soles;
pub mod stance;
mod stand_scene;
mod walker;

pub use biped::{SMALL_BODIES, biped};
pub(crate) use contacts::Contacts;
pub use from_file::NoLeggedRobot;
pub(crate) use sized_tree::with_tree;
pub use sized_tree::{LEG, MOST_LEGS, SizedTree, Start};
pub use soles::NoSole;
pub use stand_scene::stand_scene;
pub(crate) use walker::WalkerShape;

use crate::picture::Solid;
use crate::plant::RobotModel;
use nalgebra::Vector3;
use std::sync::Arc;
use surefoot::balance::{JointDamping, JointLimits, SafetyLimits, Thresholds};
use surefoot_multibody::Side;

/// A legged robot: a floating central body on legs, and what else moves.
#[derive(Clone, Debug)]
pub struct Robot {
    /// Name, for people.
    pub name: String,
    /// Bodies and joints; body 0 is the central one.
    pub tree: SizedTree,
    /// Names of the bodies in the tree's order.
    pub bodies: Vec<String>,
    /// Names of the joints in the order of torques and angles, for people.
    pub joints: Vec<String>,
    /// Whether each joint slides.
    pub slides: Vec<bool>,
    /// The same as columns of a record have them.
    pub columns: Vec<String>,
    /// Names of the legs.
    pub legs: Vec<String>,
    /// The joints of each leg, hip to foot, by their place in `joints`; body k + 1 hangs from joint k.
    pub leg_joints: Vec<Vec<usize>>,
    /// The foot of each leg.
    pub feet: Vec<Foot>,
    /// What each body looks like, in its frame.
    pub shapes: Vec<Solid>,
    /// Small bodies that a model may lump into neighbours; none where that was not measured.
    pub small_bodies: &'static [(usize, Side)],
    /// What is in its joints, in the order of torques.
    pub passive: Vec<Passive>,
    /// What its supervisor allows.
    pub limits: Limits,
    /// A central body this low has fallen, m.
    pub fallen_height: f64,
}

/// A foot.
#[derive(Clone, Debug)]
pub struct Foot {
    /// Name, for people.
    pub name: String,
    /// The same in columns of a record.
    pub column: String,
    /// Its body.
    pub body: usize,
    /// Where it touches the floor.
    pub points: Vec<FootPoint>,
    /// Which of the points are its heel and its toe; none where it has no such ends.
    pub ends: [Vec<usize>; 2],
}

/// A point of a foot.
#[derive(Clone, Debug)]
pub struct FootPoint {
    /// Name in columns of a record.
    pub column: String,
    /// In the body's frame, m.
    pub at: Vector3<f64>,
}

/// What resists in a joint, whatever its motor does.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Passive {
    /// N·m·s/rad
    pub damping: f64,
    /// Dry friction, N·m.
    pub friction: f64,
}

impl Passive {
    /// Whether nothing resists.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }
}

/// What a supervisor allows, joint by joint.
#[derive(Clone, Debug)]
pub struct Limits {
    /// Torques, angles, rates.
    pub joints: Vec<JointLimits<f64>>,
    /// How joints brake after a stop.
    pub damping: Vec<JointDamping<f64>>,
    /// For how long, s.
    pub stop_s: f64,
    /// What is no measurement, and what a fall.
    pub thresholds: Thresholds<f64>,
}

impl Robot {
    /// How many legs it has.
    pub fn leg_count(&self) -> usize {
        self.legs.len()
    }

    /// How many joints.
    pub fn joint_count(&self) -> usize {
        self.joints.len()
    }

    /// Leg of a body; `None` for the central one and for other limbs.
    pub fn leg_of(&self, body: usize) -> Option<usize> {
        let joint = body.checked_sub(1)?;
        self.leg_joints.iter().position(|joints| joints.contains(&joint))
    }

    /// How many bodies a model of it has.
    pub fn bodies_of(&self, model: RobotModel) -> usize {
        match model {
            RobotModel::Full => self.tree.bodies(),
            RobotModel::Lumped => self.tree.bodies() - self.small_bodies.len(),
        }
    }

    /// How many points its feet have.
    pub fn points_of_feet(&self) -> Vec<usize> {
        self.feet.iter().map(|foot| foot.points.len()).collect()
    }
}

impl Limits {
    /// As the supervisor of a robot with so many legs takes them; `None` for another number of them.
    pub fn sized<const LEGS: usize>(&self) -> Option<SafetyLimits<f64, LEGS>> {
        let fits = self.joints.len() == LEGS * LEG && self.damping.len() == LEGS * LEG;
        fits.then(|| SafetyLimits {
            joints: by_leg(&self.joints),
            damping: by_leg(&self.damping),
            stop_s: self.stop_s,
            thresholds: self.thresholds,
        })
    }
}

impl Limits {
    /// The same in rows of six joints, of which those that the robot has not are free: as the supervisor of a robot
    /// with other legs takes them; `None` for more joints than that.
    pub fn in_rows<const ROWS: usize>(&self) -> Option<SafetyLimits<f64, ROWS>> {
        let missing = (ROWS * LEG).checked_sub(self.joints.len())?;
        let joint = JointLimits { torque: 1.0, angle: [-1.0, 1.0], rate: 1.0 };
        let damping = JointDamping { damping: 0.0, inertia: 1.0 };
        let mut all = self.clone();
        all.joints.extend(std::iter::repeat_n(joint, missing));
        all.damping.extend(std::iter::repeat_n(damping, missing));
        all.sized()
    }
}

/// The entries of all joints by leg.
///
/// # Panics
/// If there are fewer than six a leg.
pub(crate) fn by_leg<T: Copy, const LEGS: usize>(all: &[T]) -> [[T; LEG]; LEGS] {
    std::array::from_fn(|leg| std::array::from_fn(|joint| all[LEG * leg + joint]))
}

/// A robot that scenes and runs share.
pub type SharedRobot = Arc<Robot>;

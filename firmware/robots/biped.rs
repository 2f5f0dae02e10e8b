//! The biped of §4.1, as `surefoot import` describes robots to the firmware. It faces −x.

/// What the firmware balances.
pub mod firmware {
    use surefoot::balance::{LeggedRobot, SafetyLimits, Sole};
    use surefoot::model::robots::biped;

    /// Its images are in the folder `target/firmware` below this name.
    pub const NAME: &str = "biped";
    /// Of `ROBOT` and `LIMITS`, by which the other end of the link knows them.
    pub const FINGERPRINT: u32 = 0x463784f6;
    /// Legs of six revolute joints.
    pub const LEGS: usize = 2;
    /// As the balance controller takes it.
    pub const ROBOT: LeggedRobot<f32, LEGS> = LeggedRobot::<f64, LEGS>::new(&biped::TREE).to_f32();
    /// What its supervisor allows: messages may be tighter, and no wider.
    pub const LIMITS: SafetyLimits<f32, LEGS> = biped::LIMITS.to_f32();
    /// Its soles, outline A: origin at the last joint, axes as the robot is described at home, m.
    pub const SOLES: Option<[Sole<f32>; LEGS]> =
        Some([Sole { x: [-0.2015, 0.0503], y: [-0.05, 0.05], z: -0.06 }; LEGS]);
    /// After a reset: diagonals of the gain matrices for position (1/s²), velocity (1/s), orientation
    /// (1/s²) and angular velocity (1/s).
    pub const GAINS: [[f32; 3]; 4] =
        [[50.0, 50.0, 200.0], [7.07, 7.07, 14.142], [50.0; 3], [7.07; 3]];
    /// The pose to hold after a reset: where the central body is (m), and its quaternion, scalar first.
    pub const POSITION: [f32; 3] = [0.0, 0.0, 1.1];
    /// See `POSITION`.
    pub const ORIENTATION: [f32; 4] = [1.0, 0.0, 0.0, 0.0];
}

/// The same for the whole-body controller, which walks too.
#[rustfmt::skip]
pub mod whole_body {
#[allow(unused_imports)]
use surefoot::balance::{ContactLimits, ContactPatch, JointDamping, JointLimits};
#[allow(unused_imports)]
use surefoot::balance::{SafetyLimits, Thresholds, WholeBodyFoot};
#[allow(unused_imports)]
use surefoot::model::{Link, Tree};
use surefoot::spatial::{Quaternion, Vector3};
use surefoot::model::robots::biped;

/// Of all below, by which the other end of the link knows them.
pub const FINGERPRINT: u32 = 0xcd9b1c34;
/// Joints, which are the tree's bodies but the central one.
pub const JOINTS: usize = 12;
/// Bodies of the tree.
pub const NODES: usize = 13;
/// Its coordinates.
pub const COORDINATES: usize = 19;
/// Its velocities.
pub const VELOCITIES: usize = 18;
/// Rows of six that the joints fill.
pub const ROWS: usize = 2;

/// Of all joints.
pub const TREE: Tree<f32, NODES, COORDINATES, VELOCITIES> =
    biped::TREE.to_f32();

/// Its feet. What the ground gives them is said by a message.
pub const FEET: [Option<WholeBodyFoot<f32>>; 4] = [
Some(WholeBodyFoot {
    body: 6,
    reference: Vector3::new(-0.027263382, 0.0, -0.031022627),
    axes: Quaternion { s: 0.9972197, v: Vector3::new(0.0, 0.07451751, 0.0) },
    limits: ContactLimits {
        least_force: 0.0,
        greatest_force: 0.0,
        friction: 0.0,
        patch: ContactPatch::<f32>::centered([0.115828, 0.046]),
        torques: [],
    },
}),
Some(WholeBodyFoot {
    body: 12,
    reference: Vector3::new(-0.027263382, 0.0, -0.031022627),
    axes: Quaternion { s: 0.9972197, v: Vector3::new(0.0, 0.07451751, 0.0) },
    limits: ContactLimits {
        least_force: 0.0,
        greatest_force: 0.0,
        friction: 0.0,
        patch: ContactPatch::<f32>::centered([0.115828, 0.046]),
        torques: [],
    },
}),
None,
None,
];

/// What its supervisor allows: messages may be tighter, and no wider.
pub const LIMITS: SafetyLimits<f32, ROWS> = biped::LIMITS.to_f32();
}

//! A number that tells one robot's description from another's.
//!
//! FNV-1a over the bits of every number that the controller and its supervisor compute with, in a fixed
//! order. Two ends of a line that compute with the same numbers have the same one; of two robots that
//! differ in one bit of one number, one in 4·10⁹ has the same one.

use super::robot::{LEG, LeggedRobot};
use super::{ContactPatch, SafetyLimits, Thresholds, WholeBodyFoot};
use crate::model::{Axis, JointKind, Node, Tree};
use nalgebra::{Matrix3, Vector3};

impl<const LEGS: usize> LeggedRobot<f32, LEGS> {
    /// Of the robot with what its supervisor allows. At compile time, too.
    ///
    /// ```
    /// use surefoot::balance::LeggedRobot;
    /// use surefoot::model::robots::biped;
    /// const ROBOT: LeggedRobot<f32, 2> = LeggedRobot::<f64, 2>::new(&biped::TREE).to_f32();
    /// const FINGERPRINT: u32 = ROBOT.fingerprint(&biped::LIMITS.to_f32());
    /// let mut limits = biped::LIMITS;
    /// limits.joints[1][3].torque *= 0.5;
    /// assert_ne!(ROBOT.fingerprint(&limits.to_f32()), FINGERPRINT);
    /// ```
    pub const fn fingerprint(&self, limits: &SafetyLimits<f32, LEGS>) -> u32 {
        let mut hash = Hash::new().word(LEGS as u32).vector(&self.gravity);
        hash = hash.node(&self.central);
        let mut leg = 0;
        while leg < LEGS {
            let mut k = 0;
            while k < LEG {
                hash = hash.node(&self.legs[leg][k]).joint(limits, leg, k);
                k += 1;
            }
            leg += 1;
        }
        hash.number(limits.stop_s).thresholds(&limits.thresholds).folded()
    }
}

/// Of the first `bodies` of a tree that stands on `feet`, with what its supervisor allows, whose rows of six
/// are the joints in the tree's order. What the feet are given by the ground is no part of it. At compile
/// time, too. Trees with room for more bodies than there are have the same one.
pub const fn whole_body_fingerprint<
    const N: usize,
    const NQ: usize,
    const NV: usize,
    const FEET: usize,
    const ROWS: usize,
>(
    tree: &Tree<f32, N, NQ, NV>,
    bodies: usize,
    feet: &[Option<WholeBodyFoot<f32>>; FEET],
    limits: &SafetyLimits<f32, ROWS>,
) -> u32 {
    let mut hash = Hash::new().word(bodies as u32).vector(&tree.gravity);
    let mut body = 0;
    while body < bodies && body < N {
        let node = &tree.nodes[body];
        let inboard = match node.inboard {
            Some(inboard) => inboard as u32,
            None => u32::MAX,
        };
        hash = hash.node(node).word(inboard);
        if body > 0 && body <= ROWS * LEG {
            hash = hash.joint(limits, (body - 1) / LEG, (body - 1) % LEG);
        }
        body += 1;
    }
    let mut number = 0;
    while number < FEET {
        if let Some(foot) = &feet[number] {
            let q = &foot.axes;
            hash = hash.word(number as u32).word(foot.body as u32).vector(&foot.reference);
            hash = hash.number(q.s).vector(&q.v).patch(&foot.limits.patch);
        }
        number += 1;
    }
    hash.number(limits.stop_s).thresholds(&limits.thresholds).folded()
}

/// So far.
struct Hash(u64);

impl Hash {
    const fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    const fn folded(self) -> u32 {
        (self.0 ^ (self.0 >> 32)) as u32
    }

    const fn joint<const ROWS: usize>(
        self,
        limits: &SafetyLimits<f32, ROWS>,
        row: usize,
        k: usize,
    ) -> Self {
        let (joint, damping) = (&limits.joints[row][k], &limits.damping[row][k]);
        let hash = self.number(joint.torque).number(joint.rate);
        let hash = hash.number(joint.angle[0]).number(joint.angle[1]);
        hash.number(damping.damping).number(damping.inertia)
    }

    const fn patch(self, patch: &ContactPatch<f32>) -> Self {
        self.vector(&patch.center).number(patch.half_x).number(patch.half_y)
    }

    const fn word(self, word: u32) -> Self {
        let (mut hash, bytes) = (self.0, word.to_le_bytes());
        let mut i = 0;
        while i < bytes.len() {
            hash = (hash ^ bytes[i] as u64).wrapping_mul(0x0100_0000_01b3);
            i += 1;
        }
        Self(hash)
    }

    const fn number(self, x: f32) -> Self {
        self.word(x.to_bits())
    }

    const fn vector(self, v: &Vector3<f32>) -> Self {
        let [x, y, z] = v.data.0[0];
        self.number(x).number(y).number(z)
    }

    const fn matrix(self, matrix: &Option<Matrix3<f32>>) -> Self {
        let Some(matrix) = matrix else { return self.word(0) };
        let mut hash = self.word(1);
        let mut i = 0;
        while i < 9 {
            hash = hash.number(matrix.data.0[i / 3][i % 3]);
            i += 1;
        }
        hash
    }

    const fn node(self, node: &Node<f32>) -> Self {
        let axis = match node.kind {
            JointKind::Revolute(Axis::X) => 1,
            JointKind::Revolute(Axis::Y) => 2,
            JointKind::Revolute(Axis::Z) => 3,
            JointKind::Prismatic(Axis::X) => 4,
            JointKind::Prismatic(Axis::Y) => 5,
            JointKind::Prismatic(Axis::Z) => 6,
            JointKind::Fixed => 7,
            // A legged robot's others float.
            _ => 0,
        };
        let inertia = &node.inertia;
        self.word(axis)
            .word(node.is_reversed as u32)
            .vector(&node.offset)
            .matrix(&node.home_rotation)
            .matrix(&node.home_axes)
            .number(node.rotor_inertia)
            .number(inertia.mass)
            .vector(&inertia.first_moment)
            .vector(&inertia.rotational.diagonal)
            .vector(&inertia.rotational.off_diagonal)
            .vector(&node.center)
            .matrix(&node.body_rotation)
    }

    const fn thresholds(self, t: &Thresholds<f32>) -> Self {
        self.number(t.angle_noise)
            .number(t.rate_step)
            .number(t.velocity_step)
            .number(t.angular_velocity_step)
            .number(t.gross)
            .number(t.frozen_angle)
            .word(t.doubtful_ticks as u32)
            .number(t.torque_step)
            .word(t.bridged_ticks as u32)
            .word(t.recovery_ticks as u32)
            .number(t.least_upright)
            .number(t.drop)
            .number(t.look_ahead_s)
            .number(t.free_fall)
            .number(t.free_fall_s)
            .number(t.saturation_s)
    }
}

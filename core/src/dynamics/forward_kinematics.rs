//! Algorithm 3.1: poses, velocities and accelerations of all bodies.
//!
//! # Notation
//! - `g_0k` pose, `V_k` body twist, `V̇_k` its component derivative
//! - `A = Ad_{g_{k.o,k.i}}`, `H_k` joint map, `β_k` joint velocity
//! - `a_k = Ȧ V_{k.i} + Ḣ_k β_k = ad(V_{k.o}) H_k β_k + Ḣ_k β_k` (3.11)
//!
//! ```text
//! g_{0,k.o} = g_{0,k.i} g_{k.i,k.o}      (3.1)
//! V_{k.o}   = A V_{k.i} + H_k β_k        (3.9)
//! V̇_{k.o}   = A V̇_{k.i} + H_k β̇_k + a_k  (3.10)
//! ```

use super::JointPoses;
use super::joint_motion::{JointMotion, own, own_one};
use super::joint_poses::{JointPose, coordinates};
use crate::Real;
use crate::model::{Axis, JointKind, Node, Tree};
use crate::spatial::{Pose, Quaternion, Twist};
use nalgebra::{Matrix3, Vector3};

/// Pose, velocity and acceleration of every body frame, from [`forward_kinematics`].
#[derive(Clone, Copy, Debug)]
pub struct Kinematics<T, const N: usize> {
    /// World from body.
    pub poses: [Pose<T>; N],
    /// Body twists, `V_k`, in body frames.
    pub velocities: [Twist<T>; N],
    /// Component derivatives of the body twists, `V̇_k`.
    pub accelerations: [Twist<T>; N],
}

/// Algorithm 3.1, for joint velocities and accelerations of the whole tree.
///
/// # Cost
/// O(N). Where only poses or velocities are wanted, [`body_poses`] and [`body_velocities`] cost less.
#[inline]
pub fn forward_kinematics<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    joint_poses: &JointPoses<T, N, NQ>,
    velocities: &[T; NV],
    accelerations: &[T; NV],
) -> Kinematics<T, N> {
    let mut frames = [Twist::zero(); N];
    let mut derivatives = [Twist::zero(); N];
    let mut body_velocities = [Twist::zero(); N];
    let mut body_accelerations = [Twist::zero(); N];
    for (k, (node, pose)) in tree.nodes.iter().zip(&joint_poses.relative).enumerate() {
        let (mut twist, mut derivative) = match inboard(node, &frames) {
            Some(twist) => (
                transport(pose, twist),
                inboard(node, &derivatives).map_or(Twist::zero(), |d| transport(pose, d)),
            ),
            None => (Twist::zero(), Twist::zero()),
        };
        match &node.kind {
            JointKind::Fixed => {}
            JointKind::Revolute(axis) => {
                let beta = own_one(node, velocities);
                let beta_dot = own_one(node, accelerations);
                match axis {
                    Axis::X => turn::<T, 0>(&mut twist, &mut derivative, beta, beta_dot),
                    Axis::Y => turn::<T, 1>(&mut twist, &mut derivative, beta, beta_dot),
                    Axis::Z => turn::<T, 2>(&mut twist, &mut derivative, beta, beta_dot),
                }
            }
            _ => {
                let beta = own(node, velocities);
                let motion = JointMotion::new(node, &joint_poses.positions, &beta);
                let relative = motion.relative(&beta);
                twist = twist + relative;
                derivative = derivative
                    + motion.relative(&own(node, accelerations))
                    + twist.bracket(relative)
                    + motion.map_rate;
            }
        }
        frames[k] = twist;
        derivatives[k] = derivative;
        // The centre of mass is fixed in the joint frame, so that V̇ moves to it as V does.
        body_velocities[k] = at_body(node, twist);
        body_accelerations[k] = at_body(node, derivative);
    }
    Kinematics {
        poses: body_poses(tree, joint_poses),
        velocities: body_velocities,
        accelerations: body_accelerations,
    }
}

/// (3.1): world from body, for every body. O(N).
#[inline]
pub fn body_poses<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    joint_poses: &JointPoses<T, N, NQ>,
) -> [Pose<T>; N] {
    let mut frames = [Pose { rotation: Matrix3::zeros(), position: Vector3::zeros() }; N];
    let mut poses = frames;
    for (k, (node, pose)) in tree.nodes.iter().zip(&joint_poses.relative).enumerate() {
        let frame = match inboard(node, &frames) {
            None => Pose { rotation: pose.rotation_matrix(), position: pose.translation },
            Some(inboard) => Pose {
                rotation: pose.rotation.compose(&inboard.rotation),
                position: if pose.is_translated {
                    inboard.transform_point(pose.translation)
                } else {
                    inboard.position
                },
            },
        };
        frames[k] = frame;
        poses[k] = Pose {
            rotation: match &node.body_rotation {
                None => frame.rotation,
                Some(r) => frame.rotation * r,
            },
            position: if node.is_eccentric {
                frame.transform_point(node.center)
            } else {
                frame.position
            },
        };
    }
    poses
}

/// (3.9): body twists `V_k` of every body, in body frames. O(N).
#[inline]
pub fn body_velocities<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    joint_poses: &JointPoses<T, N, NQ>,
    velocities: &[T; NV],
) -> [Twist<T>; N] {
    let mut frames = [Twist::zero(); N];
    let mut bodies = frames;
    for (k, (node, pose)) in tree.nodes.iter().zip(&joint_poses.relative).enumerate() {
        let mut twist =
            inboard(node, &frames).map_or(Twist::zero(), |inboard| transport(pose, inboard));
        match &node.kind {
            JointKind::Fixed => {}
            JointKind::Revolute(Axis::X) => twist.angular.x += own_one(node, velocities),
            JointKind::Revolute(Axis::Y) => twist.angular.y += own_one(node, velocities),
            JointKind::Revolute(Axis::Z) => twist.angular.z += own_one(node, velocities),
            _ => {
                let beta = own(node, velocities);
                let motion = JointMotion::new(node, &joint_poses.positions, &beta);
                twist = twist + motion.relative(&beta);
            }
        }
        frames[k] = twist;
        bodies[k] = at_body(node, twist);
    }
    bodies
}

/// (3.6): `dθ/dt = B(θ) β` for all joints. For quaternions this is the tangent `½ q ⋆ (0, ω)`; a
/// step along it leaves the unit sphere to second order. O(N).
pub fn position_rates<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    positions: &[T; NQ],
    velocities: &[T; NV],
) -> [T; NQ] {
    let mut rates = [T::zero(); NQ];
    for node in &tree.nodes {
        let theta = coordinates(node, positions);
        let beta = own(node, velocities);
        let [a, b, c, d, e, f] = beta;
        let mut own_rates = [T::zero(); 7];
        match &node.kind {
            JointKind::Fixed => {}
            JointKind::Revolute(_) | JointKind::Prismatic(_) => own_rates[0] = a,
            JointKind::Spherical => {
                let [s, x, y, z, ..] = theta;
                let rate = Quaternion::from_array([s, x, y, z]).rate(Vector3::new(a, b, c));
                for (to, from) in own_rates.iter_mut().zip(rate.to_array()) {
                    *to = from;
                }
            }
            JointKind::Floating => {
                let [_, _, _, s, x, y, z] = theta;
                let q = Quaternion::from_array([s, x, y, z]);
                let p = q.rotate(Vector3::new(a, b, c));
                let [qs, qx, qy, qz] = q.rate(Vector3::new(d, e, f)).to_array();
                own_rates = [p.x, p.y, p.z, qs, qx, qy, qz];
            }
            JointKind::General(joint) => own_rates = joint.motion(&theta, &beta).position_rates,
        }
        let all = rates.iter_mut().skip(node.position_start).take(node.kind.coordinates());
        for (to, from) in all.zip(own_rates) {
            *to = from;
        }
    }
    rates
}

/// The inboard body's entry, or `None` where that is the inertial frame.
#[inline(always)]
pub(super) fn inboard<'a, T, A>(node: &Node<T>, all: &'a [A]) -> Option<&'a A> {
    all.get(node.inboard?)
}

/// `A V_{k.i}`: `ω' = Rᵀω`, `v' = Rᵀ(v + ω × p)`.
#[inline(always)]
fn transport<T: Real>(pose: &JointPose<T>, twist: &Twist<T>) -> Twist<T> {
    let linear = if pose.is_translated {
        twist.linear + twist.angular.cross(&pose.translation)
    } else {
        twist.linear
    };
    Twist { linear: pose.rotation.outboard(linear), angular: pose.rotation.outboard(twist.angular) }
}

/// Adds `H β` to `V` and `H β̇ + ad(V) H β` to `V̇`, where `H` is a turn about axis `I`:
/// `v × e_I = (v_k e_j − v_j e_k)`.
#[inline(always)]
fn turn<T: Real, const I: usize>(
    twist: &mut Twist<T>,
    derivative: &mut Twist<T>,
    beta: T,
    beta_dot: T,
) {
    let (j, k) = ((I + 1) % 3, (I + 2) % 3);
    twist.angular[I] += beta;
    derivative.linear[j] += twist.linear[k] * beta;
    derivative.linear[k] -= twist.linear[j] * beta;
    derivative.angular[j] += twist.angular[k] * beta;
    derivative.angular[k] -= twist.angular[j] * beta;
    derivative.angular[I] += beta_dot;
}

/// From the joint frame to the body frame.
#[inline(always)]
fn at_body<T: Real>(node: &Node<T>, twist: Twist<T>) -> Twist<T> {
    let moved = if node.is_eccentric {
        Twist { linear: twist.linear + twist.angular.cross(&node.center), ..twist }
    } else {
        twist
    };
    match &node.body_rotation {
        None => moved,
        Some(r) => Twist { linear: r.tr_mul(&moved.linear), angular: r.tr_mul(&moved.angular) },
    }
}

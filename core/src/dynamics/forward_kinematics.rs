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
use super::joint_poses::{JointPose, coordinates, relative};
use super::reversed::along_axes;
use crate::Real;
use crate::model::{Axis, JointKind, Node, Tree};
use crate::spatial::{AxisTurn, Pose, Quaternion, Twist};
use nalgebra::{Matrix3, Vector3};

/// One body's kinematics, from [`forward_kinematics`].
#[derive(Clone, Copy, Debug)]
pub struct BodyKinematics<T> {
    /// World from body.
    pub pose: Pose<T>,
    /// Body twist, `V_k`, in the body frame.
    pub velocity: Twist<T>,
    /// Component derivative of the body twist, `V̇_k`.
    pub acceleration: Twist<T>,
}

/// Pose, velocity and acceleration of every body, from [`forward_kinematics`].
pub type Kinematics<T, const N: usize> = [BodyKinematics<T>; N];

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
    let mut bodies = [BodyKinematics::still(); N];
    forward_kinematics_in(tree, joint_poses, velocities, accelerations, &mut bodies);
    bodies
}

/// The same into a place that is there already: a copy costs a sixth of it.
#[inline]
pub(crate) fn forward_kinematics_in<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    joint_poses: &JointPoses<T, N, NQ>,
    velocities: &[T; NV],
    accelerations: &[T; NV],
    frames: &mut Kinematics<T, N>,
) {
    along_axes!(tree, velocities, accelerations);
    let base = BodyKinematics { pose: Pose::identity(), ..BodyKinematics::still() };
    // Of the joint frames first, which is where the recursion runs.
    for (k, (node, turn)) in tree.nodes.iter().zip(&joint_poses.turns).enumerate() {
        // Results are written where they stay: to put them together first and copy them then would
        // take as long as to find them.
        let (done, next) = frames.split_at_mut(k.min(N));
        let (from, Some(own)) = (inboard(node, done).unwrap_or(&base), next.first_mut()) else {
            continue;
        };
        match (&node.kind, &node.home_rotation) {
            // The joint that robots are made of, in one piece for each axis.
            (JointKind::Revolute(axis), None) => {
                let (beta, beta_dot) = (own_one(node, velocities), own_one(node, accelerations));
                match axis {
                    Axis::X => across_hinge::<T, 0>(own, node, turn, from, beta, beta_dot),
                    Axis::Y => across_hinge::<T, 1>(own, node, turn, from, beta, beta_dot),
                    Axis::Z => across_hinge::<T, 2>(own, node, turn, from, beta, beta_dot),
                }
            }
            _ => {
                let (beta, beta_dot) =
                    (self::own(node, velocities), self::own(node, accelerations));
                across_joint(own, node, turn, &joint_poses.positions, from, &beta, &beta_dot);
            }
        };
    }
    // From the joint frames to the body frames, in place. The centre of mass is fixed in the joint
    // frame, so that V̇ moves to it as V does.
    for (body, node) in frames.iter_mut().zip(&tree.nodes) {
        if node.is_eccentric {
            let c = node.center;
            body.pose.position = body.pose.transform_point(c);
            body.velocity.linear += body.velocity.angular.cross(&c);
            body.acceleration.linear += body.acceleration.angular.cross(&c);
        }
        if let Some(r) = &node.body_rotation {
            body.pose.rotation *= r;
            body.velocity = turned_back(r, body.velocity);
            body.acceleration = turned_back(r, body.acceleration);
        }
    }
}

impl<T: Real> BodyKinematics<T> {
    /// To be filled.
    pub(crate) fn still() -> Self {
        Self {
            pose: Pose { rotation: Matrix3::zeros(), position: Vector3::zeros() },
            velocity: Twist::zero(),
            acceleration: Twist::zero(),
        }
    }
}

/// (3.1): world from body, for every body. O(N).
#[inline]
pub fn body_poses<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    joint_poses: &JointPoses<T, N, NQ>,
) -> [Pose<T>; N] {
    let mut frames = [Pose { rotation: Matrix3::zeros(), position: Vector3::zeros() }; N];
    for (k, node, pose) in joint_poses.joints(&tree.nodes) {
        frames[k] = match inboard(node, &frames) {
            None => Pose { rotation: pose.rotation_matrix(), position: pose.translation },
            Some(inboard) => outboard_pose(&pose, inboard),
        };
    }
    for (body, node) in frames.iter_mut().zip(&tree.nodes) {
        if node.is_eccentric {
            body.position = body.transform_point(node.center);
        }
        if let Some(r) = &node.body_rotation {
            body.rotation *= r;
        }
    }
    frames
}

/// (3.9): body twists `V_k` of every body, in body frames. O(N).
#[inline]
pub fn body_velocities<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    joint_poses: &JointPoses<T, N, NQ>,
    velocities: &[T; NV],
) -> [Twist<T>; N] {
    along_axes!(tree, velocities);
    let mut frames = [Twist::zero(); N];
    for (k, node, pose) in joint_poses.joints(&tree.nodes) {
        let mut twist =
            inboard(node, &frames).map_or(Twist::zero(), |inboard| transport(&pose, inboard));
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
    }
    for (body, node) in frames.iter_mut().zip(&tree.nodes) {
        if node.is_eccentric {
            body.linear += body.angular.cross(&node.center);
        }
        if let Some(r) = &node.body_rotation {
            *body = turned_back(r, *body);
        }
    }
    frames
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

/// (3.1), (3.9), (3.10) across a turn about axis `I`, for which
/// `ad(V) H β = β (v_k e_j − v_j e_k, ω_k e_j − ω_j e_k)`.
#[inline(always)]
fn across_hinge<T: Real, const I: usize>(
    own: &mut BodyKinematics<T>,
    node: &Node<T>,
    turn: &AxisTurn<T>,
    from: &BodyKinematics<T>,
    beta: T,
    beta_dot: T,
) {
    let back = turn.back();
    let transport = |twist: &Twist<T>| Twist {
        linear: back.vector::<I>(if node.is_offset {
            twist.linear + twist.angular.cross(&node.offset)
        } else {
            twist.linear
        }),
        angular: back.vector::<I>(twist.angular),
    };
    let mut velocity = transport(&from.velocity);
    let mut acceleration = transport(&from.acceleration);
    let (j, k) = ((I + 1) % 3, (I + 2) % 3);
    acceleration.linear[j] += velocity.linear[k] * beta;
    acceleration.linear[k] -= velocity.linear[j] * beta;
    acceleration.angular[j] += velocity.angular[k] * beta;
    acceleration.angular[k] -= velocity.angular[j] * beta;
    acceleration.angular[I] += beta_dot;
    velocity.angular[I] += beta;
    own.velocity = velocity;
    own.acceleration = acceleration;
    own.pose.rotation = turn.columns::<I>(&from.pose.rotation);
    own.pose.position =
        if node.is_offset { from.pose.transform_point(node.offset) } else { from.pose.position };
}

/// (3.1), (3.9), (3.10) across any joint.
#[inline(never)]
fn across_joint<T: Real, const NQ: usize>(
    own: &mut BodyKinematics<T>,
    node: &Node<T>,
    turn: &AxisTurn<T>,
    positions: &[T; NQ],
    from: &BodyKinematics<T>,
    beta: &[T; 6],
    beta_dot: &[T; 6],
) {
    let pose = relative(node, *turn, positions);
    let motion = JointMotion::new(node, positions, beta);
    let relative = motion.relative(beta);
    let velocity = transport(&pose, &from.velocity) + relative;
    own.pose = outboard_pose(&pose, &from.pose);
    own.velocity = velocity;
    own.acceleration = transport(&pose, &from.acceleration)
        + motion.relative(beta_dot)
        + velocity.bracket(relative)
        + motion.map_rate;
}

/// `g_{0,k.o}` of (3.1).
#[inline(always)]
fn outboard_pose<T: Real>(pose: &JointPose<T>, inboard: &Pose<T>) -> Pose<T> {
    Pose {
        rotation: pose.rotation.compose(&inboard.rotation),
        position: if pose.is_translated {
            inboard.transform_point(pose.translation)
        } else {
            inboard.position
        },
    }
}

/// A twist in the axes of the body frame.
#[inline(always)]
fn turned_back<T: Real>(r: &Matrix3<T>, twist: Twist<T>) -> Twist<T> {
    Twist { linear: r.tr_mul(&twist.linear), angular: r.tr_mul(&twist.angular) }
}

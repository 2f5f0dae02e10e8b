//! Algorithm 3.2: joint torques for given accelerations.
//!
//! # Notation
//! In joint frames, with the classical acceleration of the origin (see the module's page):
//! - `ω, ω̇, a` angular velocity, angular acceleration, acceleration of the origin less gravity
//! - `K = ω̇ˆ + ω̂ω̂`, so that the acceleration of a point at `r` is `a + K r` (1)
//! - `m, h, J` mass, first moment, rotational inertia
//! - `I` rotor inertia of a joint
//! - `f, n` wrench through the joint: `F_{k.o}` of (3.17)
//!
//! ```text
//! f = m a + K h − f_ext + Σ f_out,   n = h × a + J ω̇ + ω × J ω − n_ext + Σ (n_out + r × f_out)  (2)
//! τ = Hᵀ (f, n) + I β̇                                                                          (3.20)
//! ```

use super::JointPoses;
use super::forward_kinematics::inboard;
use super::inverse_limbs::{FrameMotion, inboard_pass, outboard_pass};
use super::joint_motion::{JointMotion, own, own_one};
use super::joint_poses::JointPose;
use super::lanes::{Lanes, along_limb};
use super::reversed::reversed;
use crate::Real;
use crate::model::{Axis, JointKind, Node, Tree};
use crate::spatial::{Twist, Wrench};
use nalgebra::{Matrix3, Vector3};

/// The torques `τ` that give the tree the joint accelerations `accelerations` at `velocities`, under
/// gravity and `external` wrenches (each at its body's centre of mass, in its body frame). A floating
/// joint's entry is the wrench on its body, in the body frame.
///
/// Numbers that are not finite go through to the result.
///
/// # Cost
/// O(N), about 90 multiplications per revolute joint.
#[inline]
pub fn inverse_dynamics<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    joint_poses: &JointPoses<T, N, NQ>,
    velocities: &[T; NV],
    accelerations: &[T; NV],
    external: Option<&[Wrench<T>; N]>,
) -> [T; NV] {
    if tree.has_reversed || tree.has_rotors {
        return with_rotors(tree, joint_poses, velocities, accelerations, external);
    }
    recursion(tree, joint_poses, velocities, accelerations, external)
}

/// The same for trees with rotors or reversed joints. Apart, so that others do not pay for them.
#[cold]
#[inline(never)]
fn with_rotors<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    joint_poses: &JointPoses<T, N, NQ>,
    velocities: &[T; NV],
    accelerations: &[T; NV],
    external: Option<&[Wrench<T>; N]>,
) -> [T; NV] {
    let (velocities, accelerations) = (reversed(tree, velocities), reversed(tree, accelerations));
    let mut torques = recursion(tree, joint_poses, &velocities, &accelerations, external);
    // A joint without velocities has no rotor, and where its own would start is another's.
    for node in tree.nodes.iter().filter(|node| node.rotor_inertia > T::zero()) {
        if let Some(torque) = torques.get_mut(node.velocity_start) {
            *torque += node.rotor_inertia * own_one(node, &accelerations);
        }
    }
    reversed(tree, &torques)
}

/// What every pass reads.
pub(super) struct Input<'a, T, const N: usize, const NQ: usize, const NV: usize> {
    pub tree: &'a Tree<T, N, NQ, NV>,
    pub joint_poses: &'a JointPoses<T, N, NQ>,
    pub velocities: &'a [T; NV],
    pub accelerations: &'a [T; NV],
}

impl<T: Real, const N: usize, const NQ: usize, const NV: usize> Input<'_, T, N, NQ, NV> {
    /// The motion of the inertial frame.
    #[inline(always)]
    pub fn base(&self) -> FrameMotion<T> {
        let still = [T::zero(); 3];
        FrameMotion { omega: still, omega_dot: still, a: (-self.tree.gravity).into() }
    }
}

#[inline(never)]
fn recursion<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    joint_poses: &JointPoses<T, N, NQ>,
    velocities: &[T; NV],
    accelerations: &[T; NV],
    external: Option<&[Wrench<T>; N]>,
) -> [T; NV] {
    let input = Input { tree, joint_poses, velocities, accelerations };
    let mut motions = [input.base(); N];
    let mut wrenches = [Wrench::zero(); N];

    for (k, node) in tree.nodes.iter().enumerate() {
        if node.limb > 0 {
            along_limb!(T, k, node, outboard_pass(&input, &mut motions, &mut wrenches));
        } else if let (None, Some(pose)) = (node.hinge(), joint_poses.pose(k, node)) {
            let motion = step(&input, node, &pose, &motions);
            if let (Some(wrench), Some(kept)) = (wrenches.get_mut(k), motions.get_mut(k)) {
                *wrench = inertial_wrench(node, &motion);
                *kept = FrameMotion {
                    omega: motion.omega.into(),
                    omega_dot: motion.omega_dot.into(),
                    a: motion.a.into(),
                };
            }
        }
    }
    if let Some(external) = external {
        for ((wrench, node), applied) in wrenches.iter_mut().zip(&tree.nodes).zip(external) {
            *wrench -= at_joint(node, applied);
        }
    }

    let mut torques = [T::zero(); NV];
    for (k, node) in tree.nodes.iter().enumerate().rev() {
        if node.limb > 0 {
            along_limb!(T, k, node, inboard_pass(&input, &mut wrenches, &mut torques));
        } else if let (None, Some(wrench)) = (node.hinge(), wrenches.get(k).copied()) {
            project(node, &wrench, &joint_poses.positions, velocities, &mut torques);
            if let Some(inboard) = node.inboard.and_then(|i| wrenches.get_mut(i))
                && let Some(pose) = joint_poses.pose(k, node)
            {
                *inboard += carried(&pose, &wrench);
            }
        }
    }
    torques
}

/// The bias `ℂ` of (3.33): torques at zero joint acceleration, from velocity, gravity and external
/// wrenches. O(N).
#[inline]
pub fn bias_forces<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    joint_poses: &JointPoses<T, N, NQ>,
    velocities: &[T; NV],
    external: Option<&[Wrench<T>; N]>,
) -> [T; NV] {
    inverse_dynamics(tree, joint_poses, velocities, &[T::zero(); NV], external)
}

/// Motion of a joint frame, with `K`.
#[derive(Clone, Copy)]
pub(super) struct Motion<T> {
    pub omega: Vector3<T>,
    pub omega_dot: Vector3<T>,
    /// Less gravity.
    pub a: Vector3<T>,
    pub k: Matrix3<T>,
}

/// Outboard step of `ω`, `ω̇`, `a` and `K` across a joint that is not revolute.
#[inline(never)]
fn step<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    input: &Input<T, N, NQ, NV>,
    node: &Node<T>,
    pose: &JointPose<T>,
    motions: &[FrameMotion<T>; N],
) -> Motion<T> {
    let from = inboard(node, motions).copied().unwrap_or(input.base());
    let [from_omega, from_omega_dot, from_a] =
        [from.omega, from.omega_dot, from.a].map(Vector3::from);
    let transported_a = if pose.is_translated && node.inboard.is_some() {
        from_a + point_acceleration(from_omega, from_omega_dot) * pose.translation
    } else {
        from_a
    };
    let mut omega = pose.rotation.outboard(from_omega);
    let mut omega_dot = pose.rotation.outboard(from_omega_dot);
    let mut a = pose.rotation.outboard(transported_a);
    if !matches!(node.kind, JointKind::Fixed) {
        let positions = &input.joint_poses.positions;
        let beta = own(node, input.velocities);
        let motion = JointMotion::new(node, positions, &beta);
        let product = motion.velocity_product(omega, &beta);
        let change = motion.relative(&own(node, input.accelerations)) + product;
        omega += motion.relative(&beta).angular;
        omega_dot += change.angular;
        a += change.linear;
    }
    Motion { omega, omega_dot, a, k: point_acceleration(omega, omega_dot) }
}

/// Adds a turn about axis `I`: `ω + e β`, `ω̇ + e β̇ + ω × e β`.
#[inline(always)]
pub(super) fn turn<T: Real, const I: usize>(
    omega: &mut Vector3<T>,
    omega_dot: &mut Vector3<T>,
    beta: T,
    beta_dot: T,
) {
    let (j, k) = ((I + 1) % 3, (I + 2) % 3);
    omega_dot[j] += omega[k] * beta;
    omega_dot[k] -= omega[j] * beta;
    omega_dot[I] += beta_dot;
    omega[I] += beta;
}

/// `K` of (1).
#[inline(always)]
pub(super) fn point_acceleration<T: Real>(omega: Vector3<T>, omega_dot: Vector3<T>) -> Matrix3<T> {
    let (w, d) = (omega, omega_dot);
    let (xx, yy, zz) = (w.x * w.x, w.y * w.y, w.z * w.z);
    let (xy, xz, yz) = (w.x * w.y, w.x * w.z, w.y * w.z);
    Matrix3::new(
        -(yy + zz),
        xy - d.z,
        xz + d.y,
        xy + d.z,
        -(xx + zz),
        yz - d.x,
        xz - d.y,
        yz + d.x,
        -(xx + yy),
    )
}

/// The body's own part of (2).
#[inline(always)]
pub(super) fn inertial_wrench<T: Real>(node: &Node<T>, motion: &Motion<T>) -> Wrench<T> {
    let inertia = &node.inertia;
    let mut wrench = Wrench {
        force: motion.a * inertia.mass,
        torque: node.rotational_product(motion.omega_dot) + node.gyroscopic_torque(motion.omega),
    };
    if node.is_eccentric {
        wrench.force += motion.k * inertia.first_moment;
        wrench.torque += inertia.first_moment.cross(&motion.a);
    }
    wrench
}

/// `τ_k = H_kᵀ F_{k.o}` into the torques of the whole tree.
#[inline(always)]
fn project<T: Real, const NQ: usize, const NV: usize>(
    node: &Node<T>,
    wrench: &Wrench<T>,
    positions: &[T; NQ],
    velocities: &[T; NV],
    torques: &mut [T; NV],
) {
    let own_torques = torques.iter_mut().skip(node.velocity_start);
    if let JointKind::Floating = node.kind {
        for (torque, value) in own_torques.zip(wrench.to_array()) {
            *torque = value;
        }
        return;
    }
    let motion = JointMotion::new(node, positions, &own(node, velocities));
    for (torque, h) in own_torques.zip(motion.map).take(motion.degrees_of_freedom) {
        *torque = h.power(*wrench);
    }
}

/// `A_{k.i}^{k.o}ᵀ F`: the wrench through the joint, on the inboard frame.
#[inline(always)]
pub(super) fn carried<T: Real>(pose: &JointPose<T>, wrench: &Wrench<T>) -> Wrench<T> {
    let force = pose.rotation.inboard(wrench.force);
    let torque = pose.rotation.inboard(wrench.torque);
    if pose.is_translated {
        Wrench { force, torque: torque + pose.translation.cross(&force) }
    } else {
        Wrench { force, torque }
    }
}

/// A wrench at the centre of mass in the body frame, taken at the joint frame.
#[inline(always)]
pub(super) fn at_joint<T: Real>(node: &Node<T>, applied: &Wrench<T>) -> Wrench<T> {
    let turned = match &node.body_rotation {
        None => *applied,
        Some(r) => Wrench { force: r * applied.force, torque: r * applied.torque },
    };
    turned.shifted(node.center)
}

/// Velocity terms alone, for the articulated-body recursion: `ω`, `Rᵀ(K r) ` with `ω̇ = 0`, joint
/// products, and the bias wrench of the body.
#[derive(Clone, Copy)]
pub(super) struct VelocityTerms<T> {
    pub omega: Vector3<T>,
    /// `c`: acceleration of the joint frame beyond what the inboard frame's and the joint's own give.
    pub product: Twist<T>,
}

/// `c_k` of a joint from the inboard angular velocity.
#[inline(always)]
pub(super) fn velocity_terms<T: Real, const NQ: usize, const NV: usize>(
    node: &Node<T>,
    pose: &JointPose<T>,
    inboard_omega: Vector3<T>,
    positions: &[T; NQ],
    velocities: &[T; NV],
) -> VelocityTerms<T> {
    let mut omega = pose.rotation.outboard(inboard_omega);
    let linear = if pose.is_translated && node.inboard.is_some() {
        let w = inboard_omega;
        pose.rotation.outboard(w.cross(&w.cross(&pose.translation)))
    } else {
        Vector3::zeros()
    };
    let mut product = Twist { linear, angular: Vector3::zeros() };
    match &node.kind {
        JointKind::Fixed => {}
        JointKind::Revolute(axis) => {
            let beta = own_one(node, velocities);
            let (w, c) = (&mut omega, &mut product.angular);
            match axis {
                Axis::X => turn::<T, 0>(w, c, beta, T::zero()),
                Axis::Y => turn::<T, 1>(w, c, beta, T::zero()),
                Axis::Z => turn::<T, 2>(w, c, beta, T::zero()),
            }
        }
        _ => {
            let beta = own(node, velocities);
            let motion = JointMotion::new(node, positions, &beta);
            product = product + motion.velocity_product(omega, &beta);
            omega += motion.relative(&beta).angular;
        }
    }
    VelocityTerms { omega, product }
}

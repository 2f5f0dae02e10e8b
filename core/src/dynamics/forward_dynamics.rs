//! Algorithm 3.3: joint accelerations for given torques, by articulated-body inertias.
//!
//! # Notation
//! In joint frames, with classical accelerations less gravity `a'` (see the module's page):
//! - `P, z` articulated inertia and bias: `F = P a' + z` (3.36)
//! - `U = P H`, `D = Hᵀ U + I` with the joint's rotor inertia `I`, `u = τ − Hᵀ z`, `c` velocity
//!   products
//!
//! ```text
//! D β̇ = u − Uᵀ (A a'_{k.i} + c)                                            (3.59)
//! P_{k.i} += Aᵀ (P − U D⁻¹ Uᵀ) A                                           (3.51)
//! z_{k.i} += Aᵀ (z + (P − U D⁻¹ Uᵀ) c + U D⁻¹ u)                           (3.52)
//! ```
//! The text's `Lᵀ P L` equals `Aᵀ (P − U D⁻¹ Uᵀ) A` by (3.57) and costs twice as much.

use super::inverse_dynamics::{VelocityTerms, at_joint, carried, velocity_terms};
use super::joint_block::JointBlock;
use super::joint_motion::{JointMotion, own, own_one};
use super::reversed::reversed;
use super::{DynamicsFault, JointPoses};
use crate::Real;
use crate::model::{Axis, JointKind, Node, Tree};
use crate::spatial::{ArticulatedInertia, Twist, Wrench};
use nalgebra::Vector3;

/// What the inboard pass leaves for the outboard pass at a joint with one degree of freedom.
#[derive(Clone, Copy)]
pub(crate) struct Hinge<T> {
    /// `U`
    image: Wrench<T>,
    /// `D⁻¹`
    inverse: T,
    /// `u`
    excess: T,
}

/// Joint accelerations `β̇` under torques `torques`, gravity and `external` wrenches (each at its
/// body's centre of mass, in its body frame). A floating joint's six are the component derivatives of
/// its body twist, its torques a wrench on the body.
///
/// # Errors
/// [`DynamicsFault::SingularInertia`] where a joint has nothing to move,
/// [`DynamicsFault::ResultNotFinite`] where an input was not finite.
///
/// # Cost
/// O(N), about 250 multiplications and one division per revolute joint.
#[inline]
pub fn forward_dynamics<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    joint_poses: &JointPoses<T, N, NQ>,
    velocities: &[T; NV],
    torques: &[T; NV],
    external: Option<&[Wrench<T>; N]>,
) -> Result<[T; NV], DynamicsFault> {
    if tree.has_reversed || tree.has_rotors {
        return with_rotors(tree, joint_poses, velocities, torques, external);
    }
    recursion::<T, N, NQ, NV, false>(tree, joint_poses, velocities, torques, external)
}

/// The same for trees with rotors or reversed joints. Apart, so that others do not pay for them.
#[cold]
#[inline(never)]
fn with_rotors<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    joint_poses: &JointPoses<T, N, NQ>,
    velocities: &[T; NV],
    torques: &[T; NV],
    external: Option<&[Wrench<T>; N]>,
) -> Result<[T; NV], DynamicsFault> {
    let (velocities, torques) = (reversed(tree, velocities), reversed(tree, torques));
    let along =
        recursion::<T, N, NQ, NV, true>(tree, joint_poses, &velocities, &torques, external)?;
    Ok(reversed(tree, &along))
}

#[inline]
fn recursion<T: Real, const N: usize, const NQ: usize, const NV: usize, const HAS_ROTORS: bool>(
    tree: &Tree<T, N, NQ, NV>,
    joint_poses: &JointPoses<T, N, NQ>,
    velocities: &[T; NV],
    torques: &[T; NV],
    external: Option<&[Wrench<T>; N]>,
) -> Result<[T; NV], DynamicsFault> {
    let still = VelocityTerms { omega: Vector3::zeros(), product: Twist::zero() };
    let mut terms = [still; N];
    let mut p = [ArticulatedInertia::zero(); N];
    let mut z = [Wrench::zero(); N];

    for (k, node, pose) in joint_poses.joints(&tree.nodes) {
        let omega = node.inboard.and_then(|i| terms.get(i)).unwrap_or(&still).omega;
        let own = velocity_terms(node, &pose, omega, &joint_poses.positions, velocities);
        p[k] = node.inertia.into();
        z[k] = gyroscopic_wrench(node, own.omega);
        terms[k] = own;
    }
    if let Some(external) = external {
        for ((z, node), applied) in z.iter_mut().zip(&tree.nodes).zip(external) {
            *z -= at_joint(node, applied);
        }
    }

    let idle = Hinge { image: Wrench::zero(), inverse: T::zero(), excess: T::zero() };
    let mut hinges = [idle; N];
    for (k, node, pose) in joint_poses.joints(&tree.nodes).rev() {
        let (projected, bias) = match &node.kind {
            JointKind::Fixed => (p[k], z[k] + p[k].product(terms[k].product)),
            JointKind::Revolute(axis) => {
                let torque = own_one(node, torques);
                let rotor = HAS_ROTORS.then_some(node.rotor_inertia);
                let (projected, bias, hinge) =
                    project_turn(*axis, &p[k], &z[k], terms[k].product, torque, rotor)
                        .ok_or(DynamicsFault::SingularInertia { joint: k })?;
                hinges[k] = hinge;
                (projected, bias)
            }
            JointKind::Prismatic(axis) => {
                let (image, d, force) = match axis {
                    Axis::X => slide_column::<T, 0>(&p[k], &z[k]),
                    Axis::Y => slide_column::<T, 1>(&p[k], &z[k]),
                    Axis::Z => slide_column::<T, 2>(&p[k], &z[k]),
                };
                let d = if HAS_ROTORS { d + node.rotor_inertia } else { d };
                let hinge = hinge(image, d, own_one(node, torques) - force)
                    .ok_or(DynamicsFault::SingularInertia { joint: k })?;
                hinges[k] = hinge;
                project_hinge(&p[k], &z[k], &hinge, terms[k].product)
            }
            // A joint of the root passes nothing on.
            _ if node.inboard.is_none() => continue,
            _ => project_block(node, joint_poses, velocities, torques, &p[k], &z[k], terms[k])
                .ok_or(DynamicsFault::SingularInertia { joint: k })?,
        };
        if let Some(i) = node.inboard
            && let (Some(p), Some(z)) = (p.get_mut(i), z.get_mut(i))
        {
            let turned = projected.rotated_inboard(&pose.rotation);
            *p = *p + if pose.is_translated { turned.shifted(pose.translation) } else { turned };
            *z += carried(&pose, &bias);
        }
    }

    let mut result = [T::zero(); NV];
    let mut a = [Twist::zero(); N];
    for (k, node, pose) in joint_poses.joints(&tree.nodes) {
        let arrived = match node.inboard.and_then(|i| a.get(i)) {
            None => {
                Twist { linear: pose.rotation.outboard(-tree.gravity), angular: Vector3::zeros() }
            }
            Some(inboard) => {
                let at_joint = if pose.is_translated {
                    inboard.linear + inboard.angular.cross(&pose.translation)
                } else {
                    inboard.linear
                };
                Twist {
                    linear: pose.rotation.outboard(at_joint),
                    angular: pose.rotation.outboard(inboard.angular),
                }
            }
        };
        let mut acceleration = arrived + terms[k].product;
        match &node.kind {
            JointKind::Fixed => {}
            JointKind::Revolute(axis) => {
                let beta_dot = hinge_acceleration(&hinges[k], acceleration);
                match axis {
                    Axis::X => acceleration.angular.x += beta_dot,
                    Axis::Y => acceleration.angular.y += beta_dot,
                    Axis::Z => acceleration.angular.z += beta_dot,
                }
                store(&mut result, node, beta_dot);
            }
            JointKind::Prismatic(axis) => {
                let beta_dot = hinge_acceleration(&hinges[k], acceleration);
                match axis {
                    Axis::X => acceleration.linear.x += beta_dot,
                    Axis::Y => acceleration.linear.y += beta_dot,
                    Axis::Z => acceleration.linear.z += beta_dot,
                }
                store(&mut result, node, beta_dot);
            }
            _ => {
                let motion = JointMotion::new(node, &joint_poses.positions, &own(node, velocities));
                let block = JointBlock::new(&p[k], &motion)
                    .ok_or(DynamicsFault::SingularInertia { joint: k })?;
                let wrench = p[k].product(acceleration) + z[k];
                let mut beta_dot = own(node, torques);
                for (b, h) in beta_dot.iter_mut().zip(&motion.map) {
                    *b -= h.power(wrench);
                }
                block.solve(&mut beta_dot);
                acceleration = acceleration + motion.relative(&beta_dot);
                let all = result.iter_mut().skip(node.velocity_start);
                for (to, from) in all.zip(beta_dot).take(motion.degrees_of_freedom) {
                    *to = from;
                }
            }
        }
        a[k] = acceleration;
    }
    match result.iter().position(|x| !x.is_finite()) {
        Some(index) => Err(DynamicsFault::ResultNotFinite { index }),
        None => Ok(result),
    }
}

/// `(ω × (ω × h), ω × Jω)`: what a body asks for when its frame's origin does not accelerate.
#[inline(always)]
fn gyroscopic_wrench<T: Real>(node: &Node<T>, omega: Vector3<T>) -> Wrench<T> {
    let force = if node.is_eccentric {
        omega.cross(&omega.cross(&node.inertia.first_moment))
    } else {
        Vector3::zeros()
    };
    Wrench { force, torque: node.gyroscopic_torque(omega) }
}

/// The inboard step across a revolute joint, before it is carried to the inboard frame: `P − U D⁻¹ Uᵀ`,
/// `z + (P − U D⁻¹ Uᵀ) c + U D⁻¹ u`, and what the outboard pass needs. `None` where `D` is not
/// positive.
#[inline(always)]
pub(crate) fn project_turn<T: Real>(
    axis: Axis,
    p: &ArticulatedInertia<T>,
    z: &Wrench<T>,
    product: Twist<T>,
    torque: T,
    rotor_inertia: Option<T>,
) -> Option<(ArticulatedInertia<T>, Wrench<T>, Hinge<T>)> {
    let (image, d, moment) = match axis {
        Axis::X => turn_column::<T, 0>(p, z),
        Axis::Y => turn_column::<T, 1>(p, z),
        Axis::Z => turn_column::<T, 2>(p, z),
    };
    let d = rotor_inertia.map_or(d, |rotor| d + rotor);
    let hinge = hinge(image, d, torque - moment)?;
    let (projected, bias) = project_hinge(p, z, &hinge, product);
    Some((projected, bias, hinge))
}

/// `U`, `D` and `Hᵀz` of a turn about axis `I`.
#[inline(always)]
fn turn_column<T: Real, const I: usize>(
    p: &ArticulatedInertia<T>,
    z: &Wrench<T>,
) -> (Wrench<T>, T, T) {
    let image = p.angular_column::<I>();
    (image, image.torque[I], z.torque[I])
}

/// `U`, `D` and `Hᵀz` of a slide along axis `I`.
#[inline(always)]
fn slide_column<T: Real, const I: usize>(
    p: &ArticulatedInertia<T>,
    z: &Wrench<T>,
) -> (Wrench<T>, T, T) {
    let image = p.linear_column::<I>();
    (image, image.force[I], z.force[I])
}

#[inline(always)]
fn hinge<T: Real>(image: Wrench<T>, d: T, excess: T) -> Option<Hinge<T>> {
    if d > T::zero() { Some(Hinge { image, inverse: T::one() / d, excess }) } else { None }
}

/// `P − U D⁻¹ Uᵀ` and `z + (P − U D⁻¹ Uᵀ) c + U D⁻¹ u`.
#[inline(always)]
fn project_hinge<T: Real>(
    p: &ArticulatedInertia<T>,
    z: &Wrench<T>,
    hinge: &Hinge<T>,
    product: Twist<T>,
) -> (ArticulatedInertia<T>, Wrench<T>) {
    let projected = p.minus_outer(hinge.image, hinge.inverse);
    let bias = *z + projected.product(product) + hinge.image * (hinge.inverse * hinge.excess);
    (projected, bias)
}

/// (3.59) for one degree of freedom.
#[inline(always)]
fn hinge_acceleration<T: Real>(hinge: &Hinge<T>, arrived: Twist<T>) -> T {
    hinge.inverse * (hinge.excess - arrived.power(hinge.image))
}

#[inline(always)]
fn store<T: Real, const NV: usize>(all: &mut [T; NV], node: &Node<T>, value: T) {
    if let Some(entry) = all.get_mut(node.velocity_start) {
        *entry = value;
    }
}

/// The same projection for a joint with several degrees of freedom.
#[inline(never)]
fn project_block<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    node: &Node<T>,
    joint_poses: &JointPoses<T, N, NQ>,
    velocities: &[T; NV],
    torques: &[T; NV],
    p: &ArticulatedInertia<T>,
    z: &Wrench<T>,
    terms: VelocityTerms<T>,
) -> Option<(ArticulatedInertia<T>, Wrench<T>)> {
    let motion = JointMotion::new(node, &joint_poses.positions, &own(node, velocities));
    let block = JointBlock::new(p, &motion)?;
    // With D = L E Lᵀ, the columns of W = U L⁻ᵀ give U D⁻¹ Uᵀ = Σ w wᵀ / e.
    let mut excess = own(node, torques);
    for (u, h) in excess.iter_mut().zip(&motion.map) {
        *u -= h.power(*z);
    }
    let mut w = block.images;
    let mut projected = *p;
    let mut force = Wrench::zero();
    for i in 0..motion.degrees_of_freedom.min(6) {
        for j in 0..i {
            let l = block.lower[i][j];
            w[i] -= w[j] * l;
            excess[i] -= l * excess[j];
        }
        projected = projected.minus_outer(w[i], block.inverse[i]);
        force += w[i] * (block.inverse[i] * excess[i]);
    }
    let bias = *z + projected.product(terms.product) + force;
    Some((projected, bias))
}

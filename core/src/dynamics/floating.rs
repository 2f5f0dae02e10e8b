//! Algorithm 3.2 of what most legged robots are: a floating body with revolute joints, without rotors; with the frames
//! of its joints in the same sweep, for those who want them. The same operations as of
//! [`inverse_dynamics`](super::inverse_dynamics), to the last bit, in fewer instructions.
//!
//! # Notation
//! As there; `p` a joint in its inboard frame.
//! ```text
//! a ← Rᵀ (a + K p)                                                                        (1)
//! f = m a + K h,   n = h × a + J ω̇ + ω × J ω                                              (2)
//! ```

use super::inverse_dynamics::{Motion, inertial_wrench, point_acceleration, turn};
use super::{JointPoses, inverse_dynamics};
use crate::Real;
use crate::model::{Axis, JointKind, Tree};
use crate::spatial::{AxisTurn, Pose, Quaternion, Rotation, Wrench};
use nalgebra::Vector3;

/// Torques by velocity, of the floating body a wrench in its frame, and with `FRAMES` world from every joint's frame,
/// into places that are there already: copies would cost as much as the sweep. `None` for a tree that is another one.
///
/// # Cost
/// O(N), about 110 multiplications a joint.
#[inline(always)]
pub(crate) fn floating_inverse_dynamics<
    T: Real,
    const N: usize,
    const NQ: usize,
    const NV: usize,
    const FRAMES: bool,
>(
    tree: &Tree<T, N, NQ, NV>,
    poses: &JointPoses<T, N, NQ>,
    velocities: &[T; NV],
    accelerations: &[T; NV],
    frames: &mut [Pose<T>; N],
    torques: &mut [T; NV],
) -> Option<()> {
    if tree.has_reversed || tree.has_rotors {
        return None;
    }
    let (root, [px, py, pz, s, x, y, z]) = (tree.nodes.first()?, poses.positions.first_chunk()?);
    if !matches!(root.kind, JointKind::Floating) || root.inboard.is_some() {
        return None;
    }
    let rotation = Quaternion::from_array([*s, *x, *y, *z]).to_matrix();
    if FRAMES {
        *frames.first_mut()? = Pose { rotation, position: Vector3::new(*px, *py, *pz) };
    }
    let ([vx, vy, vz, wx, wy, wz], [ax, ay, az, dx, dy, dz]) =
        (velocities.first_chunk()?, accelerations.first_chunk()?);
    let omega = Vector3::new(*wx, *wy, *wz);
    let a = rotation.tr_mul(&-tree.gravity)
        + (Vector3::new(*ax, *ay, *az) + omega.cross(&Vector3::new(*vx, *vy, *vz)));
    let omega_dot = Vector3::new(*dx, *dy, *dz);
    let base = Motion { omega, omega_dot, a, k: point_acceleration(omega, omega_dot) };
    let mut motions = [base; N];
    let mut wrenches = [Wrench::zero(); N];
    *wrenches.first_mut()? = inertial_wrench(root, &base);
    for (k, (node, angle)) in tree.nodes.iter().zip(&poses.turns).enumerate().skip(1) {
        let inboard = node.inboard?;
        let JointKind::Revolute(axis) = &node.kind else { return None };
        let from = motions.get(inboard)?;
        // (1)
        let mut a = if node.is_offset { from.a + from.k * node.offset } else { from.a };
        let (mut omega, mut omega_dot) = (from.omega, from.omega_dot);
        let start = node.velocity_start;
        let (rate, acceleration) = (*velocities.get(start)?, *accelerations.get(start)?);
        if let Some(home) = &node.home_rotation {
            let rotation = about(*axis, *angle).compose(home);
            (omega, omega_dot, a) =
                (rotation.tr_mul(&omega), rotation.tr_mul(&omega_dot), rotation.tr_mul(&a));
        } else {
            let back = angle.back();
            (omega, omega_dot, a) = match axis {
                Axis::X => {
                    (back.vector::<0>(omega), back.vector::<0>(omega_dot), back.vector::<0>(a))
                }
                Axis::Y => {
                    (back.vector::<1>(omega), back.vector::<1>(omega_dot), back.vector::<1>(a))
                }
                Axis::Z => {
                    (back.vector::<2>(omega), back.vector::<2>(omega_dot), back.vector::<2>(a))
                }
            };
        }
        match axis {
            Axis::X => turn::<T, 0>(&mut omega, &mut omega_dot, rate, acceleration),
            Axis::Y => turn::<T, 1>(&mut omega, &mut omega_dot, rate, acceleration),
            Axis::Z => turn::<T, 2>(&mut omega, &mut omega_dot, rate, acceleration),
        }
        if FRAMES {
            let Pose { mut rotation, mut position } = *frames.get(inboard)?;
            if node.is_offset {
                position += rotation * node.offset;
            }
            if let Some(home) = &node.home_rotation {
                rotation *= home;
            }
            let rotation = about(*axis, *angle).compose(&rotation);
            *frames.get_mut(k)? = Pose { rotation, position };
        }
        let motion = Motion { omega, omega_dot, a, k: point_acceleration(omega, omega_dot) };
        *wrenches.get_mut(k)? = inertial_wrench(node, &motion);
        *motions.get_mut(k)? = motion;
    }
    for (k, (node, angle)) in tree.nodes.iter().zip(&poses.turns).enumerate().skip(1).rev() {
        let (JointKind::Revolute(axis), Some(inboard)) = (&node.kind, node.inboard) else {
            return None;
        };
        let Wrench { mut force, torque: mut moment } = *wrenches.get(k)?;
        *torques.get_mut(node.velocity_start)? = moment[*axis as usize % 3];
        if let Some(home) = &node.home_rotation {
            let rotation = about(*axis, *angle).compose(home);
            (force, moment) = (rotation * force, rotation * moment);
        } else {
            (force, moment) = match axis {
                Axis::X => (angle.vector::<0>(force), angle.vector::<0>(moment)),
                Axis::Y => (angle.vector::<1>(force), angle.vector::<1>(moment)),
                Axis::Z => (angle.vector::<2>(force), angle.vector::<2>(moment)),
            };
        }
        if node.is_offset {
            moment += node.offset.cross(&force);
        }
        *wrenches.get_mut(inboard)? += Wrench { force, torque: moment };
    }
    for (to, x) in torques.iter_mut().zip(wrenches.first()?.to_array()) {
        *to = x;
    }
    Some(())
}

/// Inverse dynamics without external wrenches of whatever tree, the quicker way where that is one of these.
#[inline]
pub(crate) fn legged_inverse_dynamics<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    poses: &JointPoses<T, N, NQ>,
    velocities: &[T; NV],
    accelerations: &[T; NV],
) -> [T; NV] {
    let mut torques = [T::zero(); NV];
    let found = floating_inverse_dynamics::<_, N, NQ, NV, false>(
        tree,
        poses,
        velocities,
        accelerations,
        &mut [Pose::identity(); N],
        &mut torques,
    );
    match found {
        Some(()) => torques,
        None => inverse_dynamics(tree, poses, velocities, accelerations, None),
    }
}

/// A turn about an axis.
#[inline(always)]
fn about<T: Real>(axis: Axis, turn: AxisTurn<T>) -> Rotation<T> {
    match axis {
        Axis::X => Rotation::X(turn),
        Axis::Y => Rotation::Y(turn),
        Axis::Z => Rotation::Z(turn),
    }
}

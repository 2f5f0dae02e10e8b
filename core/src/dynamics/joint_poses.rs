//! Relative poses of all joints, `g_{k.i,k.o}(θ_k)`: (3.7), (3.12).

use super::DynamicsFault;
use crate::Real;
use crate::model::{Axis, JointKind, Node, Tree};
use crate::spatial::{AxisTurn, Quaternion, Rotation};
use nalgebra::{Matrix3, Vector3};

/// The joint frames of one configuration relative to their inboard frames, from [`joint_poses`].
#[derive(Clone, Copy, Debug)]
pub struct JointPoses<T, const N: usize, const NQ: usize> {
    pub(crate) relative: [JointPose<T>; N],
    /// Kept for joints whose map depends on their coordinates.
    pub(crate) positions: [T; NQ],
}

/// Outboard frame in the inboard frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct JointPose<T> {
    pub rotation: Rotation<T>,
    pub translation: Vector3<T>,
    /// Whether the translation differs from zero by the joint's construction.
    pub is_translated: bool,
}

/// Evaluates the joints' poses at coordinates `positions`.
///
/// Quaternions are scaled to unit norm if they are within 1 in 1000 of it.
///
/// # Errors
/// [`DynamicsFault::PositionNotFinite`], [`DynamicsFault::QuaternionNotUnit`].
///
/// # Cost
/// One sine and cosine per revolute joint; O(N).
#[inline]
pub fn joint_poses<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    positions: &[T; NQ],
) -> Result<JointPoses<T, N, NQ>, DynamicsFault> {
    if let Some(index) = positions.iter().position(|x| !x.is_finite()) {
        return Err(DynamicsFault::PositionNotFinite { index });
    }
    let mut relative = [JointPose {
        rotation: Rotation::Identity,
        translation: Vector3::zeros(),
        is_translated: false,
    }; N];
    for (joint, (pose, node)) in relative.iter_mut().zip(&tree.nodes).enumerate() {
        *pose = joint_pose(node, positions).ok_or(DynamicsFault::QuaternionNotUnit { joint })?;
    }
    Ok(JointPoses { relative, positions: *positions })
}

/// The joint's own coordinates, padded with zeros.
#[inline(always)]
pub(super) fn coordinates<T: Real, const NQ: usize>(node: &Node<T>, positions: &[T; NQ]) -> [T; 7] {
    let mut theta = [T::zero(); 7];
    let own = positions.iter().skip(node.position_start).take(node.kind.coordinates());
    for (t, x) in theta.iter_mut().zip(own) {
        *t = *x;
    }
    theta
}

/// The one coordinate of a revolute or prismatic joint.
#[inline(always)]
fn coordinate<T: Real, const NQ: usize>(node: &Node<T>, positions: &[T; NQ]) -> T {
    positions.get(node.position_start).copied().unwrap_or(T::zero())
}

#[inline(always)]
fn joint_pose<T: Real, const NQ: usize>(
    node: &Node<T>,
    positions: &[T; NQ],
) -> Option<JointPose<T>> {
    let fixed =
        |rotation| JointPose { rotation, translation: node.offset, is_translated: node.is_offset };
    Some(match &node.kind {
        JointKind::Fixed => fixed(turned(node, Rotation::Identity)),
        JointKind::Revolute(axis) => {
            let turn = AxisTurn::new(coordinate(node, positions));
            let rotation = match axis {
                Axis::X => Rotation::X(turn),
                Axis::Y => Rotation::Y(turn),
                Axis::Z => Rotation::Z(turn),
            };
            fixed(turned(node, rotation))
        }
        JointKind::Prismatic(axis) => {
            let mut slide = Vector3::zeros();
            match axis {
                Axis::X => slide.x = coordinate(node, positions),
                Axis::Y => slide.y = coordinate(node, positions),
                Axis::Z => slide.z = coordinate(node, positions),
            }
            let rotation = turned(node, Rotation::Identity);
            JointPose {
                translation: node.offset + rotation.inboard(slide),
                rotation,
                is_translated: true,
            }
        }
        JointKind::Spherical => {
            let [s, x, y, z, ..] = coordinates(node, positions);
            let q = unit_quaternion([s, x, y, z])?;
            fixed(turned(node, Rotation::General(q.to_matrix())))
        }
        JointKind::Floating => {
            let [px, py, pz, s, x, y, z] = coordinates(node, positions);
            let q = unit_quaternion([s, x, y, z])?;
            JointPose {
                rotation: Rotation::General(q.to_matrix()),
                translation: Vector3::new(px, py, pz),
                is_translated: true,
            }
        }
        JointKind::General(joint) => {
            let pose = joint.motion(&coordinates(node, positions), &[T::zero(); 6]).pose;
            // The joint frames are those of the home configuration: R_home and R(θ) compose as for
            // any other joint, and the joint's own translation is given in the inboard joint frame.
            let home = turned(node, Rotation::Identity);
            JointPose {
                translation: node.offset + home.inboard(pose.position),
                rotation: turned(node, Rotation::General(pose.rotation)),
                is_translated: true,
            }
        }
    })
}

/// `R_home R(θ)`.
#[inline(always)]
fn turned<T: Real>(node: &Node<T>, rotation: Rotation<T>) -> Rotation<T> {
    match &node.home_rotation {
        None => rotation,
        Some(home) => Rotation::General(rotation.compose(home)),
    }
}

#[inline(always)]
fn unit_quaternion<T: Real>(q: [T; 4]) -> Option<Quaternion<T>> {
    let q = Quaternion::from_array(q);
    let error = q.norm_squared() - T::one();
    if error.abs() < T::of(2e-3) { q.normalized() } else { None }
}

impl<T: Real> JointPose<T> {
    /// Inboard from outboard, as a matrix.
    #[inline]
    pub(crate) fn rotation_matrix(&self) -> Matrix3<T> {
        self.rotation.to_matrix()
    }
}

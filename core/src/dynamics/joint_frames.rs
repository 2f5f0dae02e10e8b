//! Where the joints' own frames are, in which their axes are axes of coordinates.

use super::JointPoses;
use super::forward_kinematics::inboard;
use super::joint_poses::relative;
use crate::Real;
use crate::model::{Axis, JointKind, Tree};
use crate::spatial::Pose;
use nalgebra::{Matrix3, Vector3};

/// World from the frame of every joint. O(N), and less than [`body_poses`](super::body_poses).
#[inline(always)]
pub(crate) fn joint_frames<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    joint_poses: &JointPoses<T, N, NQ>,
) -> [Pose<T>; N] {
    let mut frames = [Pose { rotation: Matrix3::identity(), position: Vector3::zeros() }; N];
    for (k, (node, turn)) in tree.nodes.iter().zip(&joint_poses.turns).enumerate() {
        let from = inboard(node, &frames).copied().unwrap_or(Pose::identity());
        let Pose { mut rotation, mut position } = from;
        if let JointKind::Revolute(axis) = &node.kind {
            if node.is_offset {
                position += rotation * node.offset;
            }
            if let Some(home) = &node.home_rotation {
                rotation *= home;
            }
            rotation = match axis {
                Axis::X => turn.columns::<0>(&rotation),
                Axis::Y => turn.columns::<1>(&rotation),
                Axis::Z => turn.columns::<2>(&rotation),
            };
        } else {
            let pose = relative(node, *turn, &joint_poses.positions);
            position += rotation * pose.translation;
            rotation = pose.rotation.compose(&rotation);
        }
        frames[k] = Pose { rotation, position };
    }
    frames
}

//! Energies of a tree.

use surefoot::dynamics::JointPoses;
use surefoot::model::Tree;
use surefoot::spatial::Pose;

/// Kinetic energy, and potential energy of gravity, of a tree.
pub(super) fn energies<const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<f64, N, NQ, NV>,
    poses: &[Pose<f64>; N],
    joint_poses: &JointPoses<f64, N, NQ>,
    velocities: &[f64; NV],
) -> (f64, f64) {
    let m = surefoot::dynamics::mass_matrix(tree, joint_poses);
    let kinetic = m
        .iter()
        .zip(velocities)
        .map(|(row, v)| v * row.iter().zip(velocities).map(|(m, w)| m * w).sum::<f64>())
        .sum::<f64>()
        * 0.5;
    let potential = poses
        .iter()
        .enumerate()
        .map(|(k, pose)| -tree.body_mass(k).unwrap_or(0.0) * tree.gravity().dot(&pose.position))
        .sum();
    (kinetic, potential)
}

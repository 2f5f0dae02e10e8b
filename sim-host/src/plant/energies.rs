//! Energies of the biped.

use super::{NQ, NV};
use surefoot::dynamics::JointPoses;
use surefoot::model::robots::biped::TREE;
use surefoot::spatial::Pose;

/// Kinetic energy, and potential energy of gravity, of the biped.
pub(super) fn energies(
    poses: &[Pose<f64>; 13],
    joint_poses: &JointPoses<f64, 13, NQ>,
    velocities: &[f64; NV],
) -> (f64, f64) {
    let m = surefoot::dynamics::mass_matrix(&TREE, joint_poses);
    let kinetic = m
        .iter()
        .zip(velocities)
        .map(|(row, v)| v * row.iter().zip(velocities).map(|(m, w)| m * w).sum::<f64>())
        .sum::<f64>()
        * 0.5;
    let potential = poses
        .iter()
        .enumerate()
        .map(|(k, pose)| -TREE.body_mass(k).unwrap_or(0.0) * TREE.gravity().dot(&pose.position))
        .sum();
    (kinetic, potential)
}

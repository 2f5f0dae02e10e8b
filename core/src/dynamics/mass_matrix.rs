//! The mass matrix `𝕄 = Hᵀ φᵀ M φ H` of (3.32), by composite bodies.
//!
//! `φᵀ M φ` sums, for each joint, the inertia of all that moves with it; the text's dense product is
//! replaced by that sum (Walker and Orin 1982), passed inboard as ten numbers. Row k then follows
//! from the wrench `I^c H_k` carried inboard: `𝕄_jk = H_jᵀ Aᵀ … Aᵀ I^c H_k`.

use super::JointPoses;
use super::inverse_dynamics::carried;
use super::joint_motion::JointMotion;
use super::joint_poses::relative;
use crate::Real;
use crate::model::{Axis, JointKind, Node, Tree};
use crate::spatial::{RigidInertia, SymmetricMatrix3, Twist, Wrench};
use nalgebra::Vector3;

/// The mass matrix at one configuration; symmetric, both halves filled. Units follow the
/// velocities: kg, kg·m, kg·m².
///
/// # Cost
/// O(N · depth).
#[inline]
pub fn mass_matrix<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    joint_poses: &JointPoses<T, N, NQ>,
) -> [[T; NV]; NV] {
    let nothing = RigidInertia {
        mass: T::zero(),
        first_moment: Vector3::zeros(),
        rotational: SymmetricMatrix3::zero(),
    };
    let mut composite = [nothing; N];
    for (c, node) in composite.iter_mut().zip(&tree.nodes) {
        *c = node.inertia;
    }
    let mut matrix = [[T::zero(); NV]; NV];
    for (k, node, pose) in joint_poses.joints(&tree.nodes).rev() {
        let own = composite[k];
        if let Some(inboard) = node.inboard.and_then(|i| composite.get_mut(i)) {
            let turned = RigidInertia {
                mass: own.mass,
                first_moment: pose.rotation.inboard(own.first_moment),
                rotational: pose.rotation.inboard_symmetric(&own.rotational),
            };
            *inboard = *inboard
                + if pose.is_translated { turned.shifted(pose.translation) } else { turned };
        }
        let still = [T::zero(); 6];
        match &node.kind {
            JointKind::Fixed => {}
            JointKind::Revolute(Axis::X) => {
                row(tree, joint_poses, k, 0, turn_column::<T, 0>(&own), &mut matrix);
            }
            JointKind::Revolute(Axis::Y) => {
                row(tree, joint_poses, k, 0, turn_column::<T, 1>(&own), &mut matrix);
            }
            JointKind::Revolute(Axis::Z) => {
                row(tree, joint_poses, k, 0, turn_column::<T, 2>(&own), &mut matrix);
            }
            _ => {
                let motion = JointMotion::new(node, &joint_poses.positions, &still);
                for (i, h) in motion.map.iter().enumerate().take(motion.degrees_of_freedom) {
                    row(tree, joint_poses, k, i, own.product(*h), &mut matrix);
                }
            }
        }
    }
    if tree.has_reversed || tree.has_rotors {
        complete(tree, &mut matrix);
    }
    matrix
}

/// Turns rows and columns of reversed joints round, and adds rotor inertias to the diagonal.
#[cold]
#[inline(never)]
fn complete<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    matrix: &mut [[T; NV]; NV],
) {
    for node in &tree.nodes {
        let i = node.velocity_start;
        if node.is_reversed {
            for x in matrix.iter_mut().filter_map(|row| row.get_mut(i)) {
                *x = -*x;
            }
            for x in matrix.get_mut(i).into_iter().flatten() {
                *x = -*x;
            }
        }
        // A joint without velocities has no rotor, and its `i` is another's.
        if node.rotor_inertia > T::zero()
            && let Some(entry) = matrix.get_mut(i).and_then(|row| row.get_mut(i))
        {
            *entry += node.rotor_inertia;
        }
    }
}

/// `I^c H` of a turn about axis `I`: `(e × h, J e)`.
#[inline(always)]
fn turn_column<T: Real, const I: usize>(composite: &RigidInertia<T>) -> Wrench<T> {
    let (j, k) = ((I + 1) % 3, (I + 2) % 3);
    let h = composite.first_moment;
    let mut force = Vector3::zeros();
    force[j] = -h[k];
    force[k] = h[j];
    Wrench { force, torque: composite.rotational.column::<I>() }
}

/// Fills what column `i` of joint `k`'s map has in common with every joint inboard of it and with
/// joint `k` itself, up to and including column `i`, on both sides of the diagonal.
#[inline(always)]
fn row<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    joint_poses: &JointPoses<T, N, NQ>,
    k: usize,
    i: usize,
    image: Wrench<T>,
    matrix: &mut [[T; NV]; NV],
) {
    let Some(row) = tree.nodes.get(k).map(|node| node.velocity_start + i) else { return };
    let mut wrench = image;
    let mut at = Some(k);
    // The path to the inertial frame has at most N joints, since numbers decrease along it.
    while let Some((node, turn)) = at.and_then(|j| tree.nodes.get(j).zip(joint_poses.turns.get(j)))
    {
        let first = node.velocity_start;
        match &node.kind {
            JointKind::Fixed => {}
            // The joint that robots are made of.
            JointKind::Revolute(axis) => {
                let product = match axis {
                    Axis::X => wrench.torque.x,
                    Axis::Y => wrench.torque.y,
                    Axis::Z => wrench.torque.z,
                };
                set(matrix, row, first, product);
                set(matrix, first, row, product);
            }
            _ => {
                let columns = if at == Some(k) { i + 1 } else { node.kind.degrees_of_freedom() };
                let products = joint_products(node, joint_poses, &wrench);
                for (j, product) in products.into_iter().enumerate().take(columns) {
                    set(matrix, row, first + j, product);
                    set(matrix, first + j, row, product);
                }
            }
        }
        if node.inboard.is_some() {
            let pose = relative(node, *turn, &joint_poses.positions);
            wrench = carried(&pose, &wrench);
        }
        at = node.inboard;
    }
}

/// `H_jᵀ F` of joints that are not revolute.
#[inline(always)]
fn joint_products<T: Real, const N: usize, const NQ: usize>(
    node: &Node<T>,
    joint_poses: &JointPoses<T, N, NQ>,
    wrench: &Wrench<T>,
) -> [T; 6] {
    let mut products = [T::zero(); 6];
    match &node.kind {
        JointKind::Floating => products = wrench.to_array(),
        _ => {
            let motion = JointMotion::new(node, &joint_poses.positions, &[T::zero(); 6]);
            for (product, h) in products.iter_mut().zip(motion.map) {
                *product = Twist::power(h, *wrench);
            }
        }
    }
    products
}

#[inline(always)]
fn set<T: Real, const NV: usize>(matrix: &mut [[T; NV]; NV], i: usize, j: usize, value: T) {
    if let Some(entry) = matrix.get_mut(i).and_then(|row| row.get_mut(j)) {
        *entry = value;
    }
}

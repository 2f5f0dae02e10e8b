//! The mass matrix `𝕄 = Hᵀ φᵀ M φ H` of (3.32), by composite bodies.
//!
//! `φᵀ M φ` sums, for each joint, the inertia of all that moves with it; the text's dense product is
//! replaced by that sum (Walker and Orin 1982), passed inboard as ten numbers. Column k then follows
//! from the wrench `I^c H_k` carried inboard: `𝕄_jk = H_jᵀ Aᵀ … Aᵀ I^c H_k`. Neighbours in a chain
//! of revolute joints are carried together.

use super::JointPoses;
use super::columns::{Columns, WIDTH};
use super::joint_motion::JointMotion;
use super::joint_poses::relative;
use crate::Real;
use crate::model::{Axis, JointKind, Node, Tree};
use crate::spatial::{AxisTurn, RigidInertia, Twist, Wrench};
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
    // For each joint the inertia of all that moves with it, in the joint's frame.
    let mut composite = tree.nodes.each_ref().map(|node| node.inertia);
    let mut matrix = [[T::zero(); NV]; NV];
    let mut last = N;
    while last > 0 {
        let count = together(tree, last);
        columns_of(tree, joint_poses, &mut composite, last - count, count, &mut matrix);
        last -= count;
    }
    mirror(&mut matrix);
    if tree.has_reversed || tree.has_rotors {
        complete(tree, &mut matrix);
    }
    matrix
}

/// Adds what moves with joint `k` to its inboard body.
#[inline(always)]
fn add_inboard<T: Real, const N: usize, const NQ: usize>(
    node: &Node<T>,
    joint_poses: &JointPoses<T, N, NQ>,
    k: usize,
    composite: &mut [RigidInertia<T>; N],
) {
    // What is inboard comes before.
    let (before, after) = composite.split_at_mut(k.min(N));
    let (Some(to), Some(own)) = (node.inboard.and_then(|i| before.get_mut(i)), after.first())
    else {
        return;
    };
    let Some(turn) = joint_poses.turns.get(k) else { return };
    match node.plain_hinge() {
        Some(Axis::X) => add_turned::<T, 0>(to, own, node, turn),
        Some(Axis::Y) => add_turned::<T, 1>(to, own, node, turn),
        Some(Axis::Z) => add_turned::<T, 2>(to, own, node, turn),
        None => {
            let pose = relative(node, *turn, &joint_poses.positions);
            let turned = RigidInertia {
                mass: own.mass,
                first_moment: pose.rotation.inboard(own.first_moment),
                rotational: pose.rotation.inboard_symmetric(&own.rotational),
            };
            let arm = pose.is_translated.then_some(pose.translation);
            *to = *to + arm.map_or(turned, |arm| turned.shifted(arm));
        }
    }
}

/// Adds what a turn about axis `I` carries to the inboard frame.
#[inline(always)]
fn add_turned<T: Real, const I: usize>(
    to: &mut RigidInertia<T>,
    own: &RigidInertia<T>,
    node: &Node<T>,
    turn: &AxisTurn<T>,
) {
    let turned = RigidInertia {
        mass: own.mass,
        first_moment: turn.vector::<I>(own.first_moment),
        rotational: turn.symmetric::<I>(&own.rotational),
    };
    *to = *to + if node.is_offset { turned.shifted(node.offset) } else { turned };
}

/// How many joints before `end` go together: a chain of revolute joints, at most [`WIDTH`]; or one.
#[inline(always)]
fn together<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    end: usize,
) -> usize {
    let node = |k: usize| tree.nodes.get(k);
    let is_hinge = |k| node(k).is_some_and(|node| matches!(node.kind, JointKind::Revolute(_)));
    let mut count = 1;
    while count < WIDTH && count < end {
        let inboard = end - count - 1;
        let hangs = node(inboard + 1).is_some_and(|node| node.inboard == Some(inboard));
        if !(hangs && is_hinge(inboard) && is_hinge(inboard + 1)) {
            break;
        }
        count += 1;
    }
    count
}

/// Fills the upper half of the columns of `count` joints from `first` on, a chain of revolute joints
/// or any single joint: what they have in common with each other and with every joint inboard.
#[inline(always)]
fn columns_of<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    joint_poses: &JointPoses<T, N, NQ>,
    composite: &mut [RigidInertia<T>; N],
    first: usize,
    count: usize,
    matrix: &mut [[T; NV]; NV],
) {
    let Some(start) = tree.nodes.get(first).map(|node| node.velocity_start) else { return };
    let mut columns = Columns::zero();
    for k in (first..first + count).rev() {
        let Some(node) = tree.nodes.get(k) else { return };
        // Beside the columns, since each of the two chains of results alone would wait for itself.
        add_inboard(node, joint_poses, k, composite);
        let Some(own) = composite.get(k) else { return };
        let wrench = match &node.kind {
            JointKind::Fixed => return,
            JointKind::Revolute(Axis::X) => turn_column::<T, 0>(own),
            JointKind::Revolute(Axis::Y) => turn_column::<T, 1>(own),
            JointKind::Revolute(Axis::Z) => turn_column::<T, 2>(own),
            JointKind::Floating => return floating(node, own, matrix),
            _ => return several(tree, joint_poses, k, node, own, matrix),
        };
        columns.set(k - first, wrench);
        project(node, joint_poses, &columns, start, count, matrix);
        if k > first {
            carry(tree, joint_poses, k, &mut columns);
        }
    }
    inboard(tree, joint_poses, first, columns, start, count, matrix);
}

/// The same for a floating joint, which has none inboard: `f = m v + ω × h`, `τ = h × v + J ω`.
#[inline(always)]
fn floating<T: Real, const NV: usize>(
    node: &Node<T>,
    own: &RigidInertia<T>,
    matrix: &mut [[T; NV]; NV],
) {
    let Some(rows) = matrix.get_mut(node.velocity_start..).and_then(|m| m.first_chunk_mut::<6>())
    else {
        return;
    };
    let zero = T::zero();
    let (m, h) = (own.mass, own.first_moment);
    let (d, o) = (own.rotational.diagonal, own.rotational.off_diagonal);
    let block = [
        [m, zero, zero, zero, h.z, -h.y],
        [zero, m, zero, -h.z, zero, h.x],
        [zero, zero, m, h.y, -h.x, zero],
        [zero, zero, zero, d.x, o.z, o.y],
        [zero, zero, zero, zero, d.y, o.x],
        [zero, zero, zero, zero, zero, d.z],
    ];
    for (row, values) in rows.iter_mut().zip(block) {
        if let Some(to) = row.get_mut(node.velocity_start..).and_then(|r| r.first_chunk_mut()) {
            *to = values;
        }
    }
}

/// The same for a joint that does not turn, column after column.
#[inline(never)]
fn several<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    joint_poses: &JointPoses<T, N, NQ>,
    k: usize,
    node: &Node<T>,
    own: &RigidInertia<T>,
    matrix: &mut [[T; NV]; NV],
) {
    let motion = JointMotion::new(node, &joint_poses.positions, &[T::zero(); 6]);
    for (i, h) in motion.map.iter().enumerate().take(motion.degrees_of_freedom) {
        let column = node.velocity_start + i;
        let wrench = own.product(*h);
        for (j, product) in joint_products(node, joint_poses, &wrench).into_iter().enumerate() {
            // Up to and including the diagonal.
            if j <= i {
                set(matrix, node.velocity_start + j, column, &[product], 1);
            }
        }
        let mut columns = Columns::zero();
        columns.set(0, wrench);
        inboard(tree, joint_poses, k, columns, column, 1, matrix);
    }
}

/// Carries columns from joint `from` along the path to the inertial frame.
#[inline(always)]
fn inboard<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    joint_poses: &JointPoses<T, N, NQ>,
    from: usize,
    mut columns: Columns<T>,
    start: usize,
    count: usize,
    matrix: &mut [[T; NV]; NV],
) {
    let mut at = from;
    // The path has at most N joints, since numbers decrease along it.
    while let Some(inboard) = tree.nodes.get(at).and_then(|node| node.inboard) {
        carry(tree, joint_poses, at, &mut columns);
        at = inboard;
        let Some(node) = tree.nodes.get(at) else { return };
        project(node, joint_poses, &columns, start, count, matrix);
    }
}

/// Columns in the frame of joint `k`, in its inboard frame.
#[inline(always)]
fn carry<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    joint_poses: &JointPoses<T, N, NQ>,
    k: usize,
    columns: &mut Columns<T>,
) {
    let Some((node, turn)) = tree.nodes.get(k).zip(joint_poses.turns.get(k)) else { return };
    match node.plain_hinge() {
        Some(Axis::X) => columns.turn::<0>(turn),
        Some(Axis::Y) => columns.turn::<1>(turn),
        Some(Axis::Z) => columns.turn::<2>(turn),
        None => return columns.carry(&relative(node, *turn, &joint_poses.positions)),
    }
    if node.is_offset {
        columns.shift(node.offset);
    }
}

/// `H_jᵀ F` of joint `node` and the first `count` columns, into its rows of the matrix from column
/// `start` on.
#[inline(always)]
fn project<T: Real, const NQ: usize, const N: usize, const NV: usize>(
    node: &Node<T>,
    joint_poses: &JointPoses<T, N, NQ>,
    columns: &Columns<T>,
    start: usize,
    count: usize,
    matrix: &mut [[T; NV]; NV],
) {
    let row = node.velocity_start;
    match &node.kind {
        JointKind::Fixed => {}
        JointKind::Revolute(Axis::X) => set(matrix, row, start, columns.torques::<0>(), count),
        JointKind::Revolute(Axis::Y) => set(matrix, row, start, columns.torques::<1>(), count),
        JointKind::Revolute(Axis::Z) => set(matrix, row, start, columns.torques::<2>(), count),
        JointKind::Floating => {
            for (j, values) in columns.rows().enumerate() {
                set(matrix, row + j, start, values, count);
            }
        }
        _ => {
            for i in 0..count {
                let products = joint_products(node, joint_poses, &columns.column(i));
                let degrees_of_freedom = node.kind.degrees_of_freedom();
                for (j, product) in products.into_iter().enumerate().take(degrees_of_freedom) {
                    set(matrix, row + j, start + i, &[product], 1);
                }
            }
        }
    }
}

/// `H_jᵀ F` of joints that are not revolute.
#[inline(never)]
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

/// Writes the first `count` values into a row of the matrix.
#[inline(always)]
fn set<T: Real, const M: usize, const NV: usize>(
    matrix: &mut [[T; NV]; NV],
    row: usize,
    start: usize,
    values: &[T; M],
    count: usize,
) {
    let Some(to) = matrix.get_mut(row).and_then(|row| row.get_mut(start..)) else { return };
    if let (true, Some(to)) = (count == M, to.first_chunk_mut::<M>()) {
        *to = *values;
    } else {
        for (to, value) in to.iter_mut().zip(values).take(count) {
            *to = *value;
        }
    }
}

/// Copies the upper half into the lower one, tile by tile: a column of a large matrix is spread over
/// as many lines of a cache as it has rows.
#[inline(always)]
fn mirror<T: Real, const NV: usize>(matrix: &mut [[T; NV]; NV]) {
    const TILE: usize = 8;
    for rows in (0..NV).step_by(TILE) {
        for columns in (0..=rows).step_by(TILE) {
            for i in rows..(rows + TILE).min(NV) {
                for j in columns..(columns + TILE).min(i) {
                    matrix[i][j] = matrix[j][i];
                }
            }
        }
    }
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

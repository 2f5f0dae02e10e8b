//! The passes of `inverse_dynamics.rs` along limbs of revolute joints.

use super::inverse_dynamics::Input;
use super::joint_motion::own_one;
use super::lanes::{Lanes, V, cross, dot, for_each_lane, plus, times, turned, vector};
use super::limbs::{Nodes, at, axis, home, joint, lane, outboard};
use crate::model::{Axis, InertiaShape};
use crate::spatial::Wrench;

/// `ω, ω̇, a` of a frame.
#[derive(Clone, Copy)]
pub(super) struct FrameMotion<L> {
    pub omega: V<L>,
    pub omega_dot: V<L>,
    /// Less gravity.
    pub a: V<L>,
}

impl<L: Lanes> FrameMotion<L> {
    /// `K` of (1), rows.
    #[inline(always)]
    fn point_acceleration(&self) -> [V<L>; 3] {
        let ([x, y, z], d) = (self.omega, self.omega_dot);
        let (xx, yy, zz) = (x * x, y * y, z * z);
        let (xy, xz, yz) = (x * y, x * z, y * z);
        [
            [-(yy + zz), xy - d[2], xz + d[1]],
            [xy + d[2], -(xx + zz), yz - d[0]],
            [xz - d[1], yz + d[0], -(xx + yy)],
        ]
    }
}

/// Outboard along a limb: motions, and what they ask of each link.
#[inline(always)]
pub(super) fn outboard_pass<L: Lanes, const N: usize, const NQ: usize, const NV: usize>(
    input: &Input<L::Scalar, N, NQ, NV>,
    motions: &mut [FrameMotion<L::Scalar>; N],
    wrenches: &mut [Wrench<L::Scalar>; N],
    start: L::Each<usize>,
    count: usize,
) -> Option<()> {
    let (nodes, _) = at::<L, N, NQ, NV>(input.tree, input.joint_poses, start)?;
    let base = input.base();
    let from = L::each(nodes, |node| {
        Some(node.inboard.and_then(|i| motions.get(i)).copied().unwrap_or(base))
    })?;
    let mut motion = FrameMotion {
        omega: [0, 1, 2].map(|i| L::gather(from, |from| from.omega[i % 3])),
        omega_dot: [0, 1, 2].map(|i| L::gather(from, |from| from.omega_dot[i % 3])),
        a: [0, 1, 2].map(|i| L::gather(from, |from| from.a[i % 3])),
    };
    let mut k_rows = None;
    for i in 0..count {
        let here = joint::<L>(start, i);
        let (nodes, turn) = at::<L, N, NQ, NV>(input.tree, input.joint_poses, here)?;
        let first = L::first(nodes);
        if first.is_offset && first.inboard.is_some() {
            let offset = vector::<L, _>(nodes, |node| node.offset);
            let rows: [V<L>; 3] = k_rows.unwrap_or_else(|| motion.point_acceleration());
            motion.a = plus(&motion.a, &rows.map(|row| dot(&row, &offset)));
        }
        let beta = L::gather(nodes, |node| own_one(node, input.velocities));
        let beta_dot = L::gather(nodes, |node| own_one(node, input.accelerations));
        match axis(first) {
            Axis::X => turn_out::<L, 0>(nodes, turn, &mut motion, beta, beta_dot),
            Axis::Y => turn_out::<L, 1>(nodes, turn, &mut motion, beta, beta_dot),
            Axis::Z => turn_out::<L, 2>(nodes, turn, &mut motion, beta, beta_dot),
        };
        k_rows = first.is_eccentric.then(|| motion.point_acceleration());
        let (force, torque) = inertial_wrench::<L>(nodes, &motion, k_rows.as_ref());
        for_each_lane!(L, here, |i, k| {
            if let Some(wrench) = wrenches.get_mut(k) {
                *wrench = Wrench { force: lane(&force, i).into(), torque: lane(&torque, i).into() };
            }
        });
    }
    for_each_lane!(L, joint::<L>(start, count.saturating_sub(1)), |i, k| {
        if let Some(kept) = motions.get_mut(k) {
            *kept = FrameMotion {
                omega: lane(&motion.omega, i),
                omega_dot: lane(&motion.omega_dot, i),
                a: lane(&motion.a, i),
            };
        }
    });
    Some(())
}

/// Across a turn about axis `I`: `ω + e β`, `ω̇ + e β̇ + ω × e β`.
#[inline(always)]
fn turn_out<L: Lanes, const I: usize>(
    nodes: Nodes<L>,
    turn: (L, L),
    from: &mut FrameMotion<L>,
    beta: L,
    beta_dot: L,
) {
    let (j, k) = ((I + 1) % 3, (I + 2) % 3);
    let mut omega = outboard::<L, I>(nodes, turn, &from.omega);
    let mut omega_dot = outboard::<L, I>(nodes, turn, &from.omega_dot);
    omega_dot[j] = omega_dot[j] + omega[k] * beta;
    omega_dot[k] = omega_dot[k] - omega[j] * beta;
    omega_dot[I] = omega_dot[I] + beta_dot;
    omega[I] = omega[I] + beta;
    *from = FrameMotion { omega, omega_dot, a: outboard::<L, I>(nodes, turn, &from.a) };
}

/// The body's own part of (2).
#[inline(always)]
fn inertial_wrench<L: Lanes>(
    nodes: Nodes<L>,
    motion: &FrameMotion<L>,
    k_rows: Option<&[V<L>; 3]>,
) -> (V<L>, V<L>) {
    let first = L::first(nodes);
    let diagonal = vector::<L, _>(nodes, |node| node.inertia.rotational.diagonal);
    let products = (first.shape == InertiaShape::Full)
        .then(|| vector::<L, _>(nodes, |node| node.inertia.rotational.off_diagonal));
    let product = |v: &V<L>| match products {
        None => [diagonal[0] * v[0], diagonal[1] * v[1], diagonal[2] * v[2]],
        Some(o) => [
            diagonal[0] * v[0] + o[2] * v[1] + o[1] * v[2],
            o[2] * v[0] + diagonal[1] * v[1] + o[0] * v[2],
            o[1] * v[0] + o[0] * v[1] + diagonal[2] * v[2],
        ],
    };
    let mut force = times(&motion.a, L::gather(nodes, |node| node.inertia.mass));
    let mut torque = product(&motion.omega_dot);
    if first.shape != InertiaShape::Isotropic {
        torque = plus(&torque, &cross(&motion.omega, &product(&motion.omega)));
    }
    if let Some(rows) = k_rows {
        let h = vector::<L, _>(nodes, |node| node.inertia.first_moment);
        force = plus(&force, &rows.map(|row| dot(&row, &h)));
        torque = plus(&torque, &cross(&h, &motion.a));
    }
    (force, torque)
}

/// Inboard along a limb: torques, and the wrench on the body that it hangs from.
#[inline(always)]
pub(super) fn inboard_pass<L: Lanes, const N: usize, const NQ: usize, const NV: usize>(
    input: &Input<L::Scalar, N, NQ, NV>,
    wrenches: &mut [Wrench<L::Scalar>; N],
    torques: &mut [L::Scalar; NV],
    start: L::Each<usize>,
    count: usize,
) -> Option<()> {
    let zero = [L::splat(nalgebra::zero()); 3];
    let mut carried = [zero; 2];
    for i in (0..count).rev() {
        let here = joint::<L>(start, i);
        let (nodes, turn) = at::<L, N, NQ, NV>(input.tree, input.joint_poses, here)?;
        let own = L::each(here, |k| wrenches.get(k).copied())?;
        let force = plus(&vector::<L, _>(own, |wrench| wrench.force), &carried[0]);
        let torque = plus(&vector::<L, _>(own, |wrench| wrench.torque), &carried[1]);
        let wrench = [force, torque];
        let (next, along) = match axis(L::first(nodes)) {
            Axis::X => (turn_in::<L, 0>(nodes, turn, &wrench), torque[0]),
            Axis::Y => (turn_in::<L, 1>(nodes, turn, &wrench), torque[1]),
            Axis::Z => (turn_in::<L, 2>(nodes, turn, &wrench), torque[2]),
        };
        carried = next;
        for_each_lane!(L, nodes, |i, node| {
            if let Some(entry) = torques.get_mut(node.velocity_start) {
                *entry = along.lane(i);
            }
        });
    }
    let (nodes, _) = at::<L, N, NQ, NV>(input.tree, input.joint_poses, start)?;
    for_each_lane!(L, nodes, |i, node| {
        if let Some(wrench) = node.inboard.and_then(|inboard| wrenches.get_mut(inboard)) {
            *wrench +=
                Wrench { force: lane(&carried[0], i).into(), torque: lane(&carried[1], i).into() };
        }
    });
    Some(())
}

/// A wrench across a turn about axis `I`.
#[inline(always)]
fn turn_in<L: Lanes, const I: usize>(
    nodes: Nodes<L>,
    turn: (L, L),
    wrench: &[V<L>; 2],
) -> [V<L>; 2] {
    let mut carried = [turned::<L, I>(turn, &wrench[0]), turned::<L, I>(turn, &wrench[1])];
    if let Some(rows) = home::<L>(nodes) {
        carried = carried.map(|v| rows.map(|row| dot(&row, &v)));
    }
    if L::first(nodes).is_offset {
        let offset = vector::<L, _>(nodes, |node| node.offset);
        carried[1] = plus(&carried[1], &cross(&offset, &carried[0]));
    }
    carried
}

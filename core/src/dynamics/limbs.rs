//! How the passes of a recursion read the joints of a limb, or of a limb and its twin.

use super::JointPoses;
use super::lanes::{Lanes, V, turned};
use crate::model::{Axis, JointKind, Node, Tree};

/// Each lane of three components.
#[inline(always)]
pub(super) fn lane<L: Lanes>(v: &V<L>, i: usize) -> V<L::Scalar> {
    v.map(|x| x.lane(i))
}

/// Joint `i` of a limb.
#[inline(always)]
pub(super) fn joint<L: Lanes>(start: L::Each<usize>, i: usize) -> L::Each<usize> {
    // Cannot fail.
    L::each(start, |k| Some(k + i)).unwrap_or(start)
}

/// Constants of a joint in each lane.
pub(super) type Nodes<'a, L> = <L as Lanes>::Each<&'a Node<<L as Lanes>::Scalar>>;

/// Constants, state and turn of a joint.
#[inline(always)]
pub(super) fn at<'a, L: Lanes, const N: usize, const NQ: usize, const NV: usize>(
    tree: &'a Tree<L::Scalar, N, NQ, NV>,
    joint_poses: &'a JointPoses<L::Scalar, N, NQ>,
    joint: L::Each<usize>,
) -> Option<(Nodes<'a, L>, (L, L))> {
    let nodes = L::each(joint, |k| tree.nodes.get(k))?;
    let turns = L::each(joint, |k| joint_poses.turns.get(k))?;
    Some((nodes, (L::gather(turns, |t| t.cosine), L::gather(turns, |t| t.sine))))
}

/// The axis that a limb's joint has in every lane.
#[inline(always)]
pub(super) fn axis<T>(node: &Node<T>) -> Axis {
    match node.kind {
        JointKind::Revolute(axis) => axis,
        _ => Axis::X,
    }
}

/// `Rᵀ v` of a joint about axis `I`.
#[inline(always)]
pub(super) fn outboard<L: Lanes, const I: usize>(
    nodes: Nodes<L>,
    (c, s): (L, L),
    v: &V<L>,
) -> V<L> {
    match home::<L>(nodes) {
        None => turned::<L, I>((c, -s), v),
        Some(rows) => {
            let back = [0, 1, 2].map(|i| rows[0][i] * v[0] + rows[1][i] * v[1] + rows[2][i] * v[2]);
            turned::<L, I>((c, -s), &back)
        }
    }
}

/// Rows of the home rotation, where there is one.
#[inline(always)]
pub(super) fn home<L: Lanes>(nodes: Nodes<L>) -> Option<[V<L>; 3]> {
    let matrices = L::each(nodes, |node| node.home_rotation.as_ref())?;
    Some([0, 1, 2].map(|i| [0, 1, 2].map(|j| L::gather(matrices, |m| m.data.0[j % 3][i % 3]))))
}

//! Which joints the recursions may take in a row, and which rows side by side.

use super::{Axis, JointKind, Node};

/// The nodes with their limbs marked, and limbs with a twin: two limbs that hang from one body, or one
/// each from a limb and its twin, and whose joints agree in all that decides which operations they need.
pub(super) const fn with_limbs<const N: usize>(mut nodes: [Node<f64>; N]) -> [Node<f64>; N] {
    let mut children = [0_usize; N];
    let mut k = 0;
    while k < N {
        if let Some(i) = nodes[k].inboard {
            children[i] += 1;
        }
        k += 1;
    }
    // Of each node, the one its limb begins with.
    let mut starts = [0; N];
    let mut k = 0;
    while k < N {
        let continues = match nodes[k].inboard {
            Some(i) => i + 1 == k && children[i] == 1 && is_hinge(&nodes[i]) && is_hinge(&nodes[k]),
            None => false,
        };
        starts[k] = if continues { starts[k - 1] } else { k };
        if is_hinge(&nodes[k]) {
            nodes[starts[k]].limb += 1;
        }
        let next_continues = k + 1 < N
            && children[k] == 1
            && is_hinge(&nodes[k])
            && is_hinge(&nodes[k + 1])
            && matches!(nodes[k + 1].inboard, Some(i) if i == k);
        nodes[k].is_branch = children[k] > 0 && !next_continues;
        k += 1;
    }
    let mut a = 0;
    while a < N {
        let mut b = a + 1;
        while b < N && nodes[a].limb > 0 && nodes[a].twin == 0 {
            if nodes[b].limb == nodes[a].limb && are_twins(&nodes, a, b) {
                nodes[a].twin = b;
                nodes[b].limb = 0;
            }
            b += 1;
        }
        a += 1;
    }
    nodes
}

const fn is_hinge(node: &Node<f64>) -> bool {
    matches!(node.kind, JointKind::Revolute(_))
}

/// Whether the limbs that begin with nodes `a` and `b`, of one length, can go together.
const fn are_twins<const N: usize>(nodes: &[Node<f64>; N], a: usize, b: usize) -> bool {
    let hang_alike = match (nodes[a].inboard, nodes[b].inboard) {
        (None, None) => true,
        (Some(i), Some(j)) => i == j || ends_twins(nodes, i, j),
        _ => false,
    };
    let mut alike = hang_alike;
    let mut i = 0;
    while i < nodes[a].limb {
        alike = alike && need_the_same(&nodes[a + i], &nodes[b + i]);
        i += 1;
    }
    alike
}

/// Whether node `i` of a limb and node `j` of its twin correspond.
const fn ends_twins<const N: usize>(nodes: &[Node<f64>; N], i: usize, j: usize) -> bool {
    let mut start = i;
    while nodes[start].limb == 0 && start > 0 {
        start -= 1;
    }
    nodes[start].twin > 0 && start + nodes[start].limb > i && nodes[start].twin + (i - start) == j
}

/// Whether two revolute joints with their bodies need the same operations.
const fn need_the_same(a: &Node<f64>, b: &Node<f64>) -> bool {
    let axes = match (&a.kind, &b.kind) {
        (JointKind::Revolute(a), JointKind::Revolute(b)) => {
            matches!((a, b), (Axis::X, Axis::X) | (Axis::Y, Axis::Y) | (Axis::Z, Axis::Z))
        }
        _ => false,
    };
    axes && a.is_offset == b.is_offset
        && a.is_eccentric == b.is_eccentric
        && a.shape as u8 == b.shape as u8
        && a.is_branch == b.is_branch
        && a.home_rotation.is_some() == b.home_rotation.is_some()
        && a.body_rotation.is_some() == b.body_rotation.is_some()
}

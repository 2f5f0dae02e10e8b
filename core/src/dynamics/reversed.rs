//! Joints whose axis points against their frame's: a joint about −x is one about x whose coordinate
//! counts backwards.
//!
//! The recursions know only coordinates that count along the frame's axes. What comes in or goes out
//! by the velocity of a reversed joint changes its sign here; a tree that has no such joint pays one
//! test for it.

use crate::Real;
use crate::model::Tree;

/// The numbers of `all`, one a velocity, with those of reversed joints negated.
#[cold]
#[inline(never)]
pub(super) fn reversed<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    all: &[T; NV],
) -> [T; NV] {
    let mut turned = *all;
    for node in tree.nodes.iter().filter(|node| node.is_reversed) {
        if let Some(x) = turned.get_mut(node.velocity_start) {
            *x = -*x;
        }
    }
    turned
}

/// The same for coordinates.
#[cold]
#[inline(never)]
pub(super) fn reverse_positions<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    positions: &mut [T; NQ],
) {
    for node in tree.nodes.iter().filter(|node| node.is_reversed) {
        if let Some(x) = positions.get_mut(node.position_start) {
            *x = -*x;
        }
    }
}

/// Shadows arrays, one number a velocity, by those in the frames' sense: themselves where no joint is
/// reversed.
macro_rules! along_axes {
    ($tree:expr, $($array:ident),+) => {
        $(
            let turned;
            let $array = if $tree.has_reversed {
                turned = super::reversed::reversed($tree, $array);
                &turned
            } else {
                $array
            };
        )+
    };
}
pub(super) use along_axes;

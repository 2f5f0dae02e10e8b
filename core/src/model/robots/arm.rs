//! A serial arm on a fixed base: six revolute joints, one of them oblique, and a prismatic gripper.

use crate::model::{Link, Tree};

/// The arm in precision `T`.
pub type Arm<T> = Tree<T, 7, 7, 7>;

/// In double precision.
pub const TREE: Arm<f64> = Tree::new([
    Link::revolute(0, [0.0, 0.0, 1.0], [0.0, 0.0, 0.10]).body(
        4.0,
        [0.03, 0.03, 0.02],
        [0.0, 0.0, 0.20],
    ),
    Link::revolute(1, [0.0, 1.0, 0.0], [0.0, 0.0, 0.30]).body(
        3.5,
        [0.06, 0.06, 0.01],
        [0.0, 0.03, 0.50],
    ),
    Link::revolute(2, [0.0, 1.0, 0.0], [0.0, 0.0, 0.70]).body(
        2.5,
        [0.02, 0.03, 0.02],
        [0.15, 0.0, 0.70],
    ),
    Link::revolute(3, [1.0, 0.0, 0.0], [0.30, 0.0, 0.70]).body(
        1.5,
        [0.003, 0.008, 0.008],
        [0.38, 0.0, 0.71],
    ),
    // The oblique wrist: its axis lies between y and z.
    Link::revolute(4, [0.0, 1.0, 1.0], [0.45, 0.0, 0.70]).body_with_products(
        1.0,
        [0.002, 0.003, 0.003, 0.0004, 0.0002, -0.0003],
        [0.48, 0.01, 0.70],
    ),
    Link::revolute(5, [1.0, 0.0, 0.0], [0.50, 0.0, 0.70])
        .body(0.6, [0.0006, 0.0009, 0.0009], [0.55, 0.0, 0.70])
        .oriented([0.8, 0.0, 0.6, 0.0]),
    Link::prismatic(6, [1.0, 0.0, 0.0]).body(0.2, [0.0001, 0.0001, 0.0001], [0.60, 0.02, 0.70]),
]);

/// In single precision, for the target.
pub const TREE_F32: Arm<f32> = TREE.to_f32();

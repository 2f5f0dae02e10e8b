//! Trees in single precision, for targets whose floating-point unit has no other.

use super::Tree;
use super::node::{EMPTY, Node};
use crate::spatial::{RigidInertia, SymmetricMatrix3};
use nalgebra::{Matrix3, Vector3};

impl<const N: usize, const NQ: usize, const NV: usize> Tree<f64, N, NQ, NV> {
    /// The same tree in single precision, every number rounded to the nearest.
    pub const fn to_f32(&self) -> Tree<f32, N, NQ, NV> {
        let mut nodes = [node(&EMPTY); N];
        let mut k = 0;
        while k < N {
            nodes[k] = node(&self.nodes[k]);
            k += 1;
        }
        Tree { nodes, gravity: vector(&self.gravity) }
    }
}

const fn node(node: &Node<f64>) -> Node<f32> {
    Node {
        kind: node.kind,
        inboard: node.inboard,
        position_start: node.position_start,
        velocity_start: node.velocity_start,
        offset: vector(&node.offset),
        is_offset: node.is_offset,
        home_rotation: match &node.home_rotation {
            Some(m) => Some(matrix(m)),
            None => None,
        },
        inertia: RigidInertia {
            mass: node.inertia.mass as f32,
            first_moment: vector(&node.inertia.first_moment),
            rotational: SymmetricMatrix3 {
                diagonal: vector(&node.inertia.rotational.diagonal),
                off_diagonal: vector(&node.inertia.rotational.off_diagonal),
            },
        },
        is_eccentric: node.is_eccentric,
        shape: node.shape,
        center: vector(&node.center),
        body_rotation: match &node.body_rotation {
            Some(m) => Some(matrix(m)),
            None => None,
        },
    }
}

const fn vector(v: &Vector3<f64>) -> Vector3<f32> {
    let [x, y, z] = v.data.0[0];
    Vector3::new(x as f32, y as f32, z as f32)
}

const fn matrix(m: &Matrix3<f64>) -> Matrix3<f32> {
    // nalgebra stores columns.
    let [x, y, z] = m.data.0;
    Matrix3::new(
        x[0] as f32,
        y[0] as f32,
        z[0] as f32,
        x[1] as f32,
        y[1] as f32,
        z[1] as f32,
        x[2] as f32,
        y[2] as f32,
        z[2] as f32,
    )
}

//! Trees in single precision, for targets whose floating-point unit has no other.

use super::Tree;
use super::node::{EMPTY, Node};
use crate::spatial::{RigidInertia, SymmetricMatrix3};
use nalgebra::{Matrix3, Vector3};

impl<const N: usize, const NQ: usize, const NV: usize> Tree<f64, N, NQ, NV> {
    /// The same tree in single precision, every number rounded to the nearest.
    pub const fn to_f32(&self) -> Tree<f32, N, NQ, NV> {
        let mut nodes = [EMPTY.rounded(); N];
        let mut k = 0;
        while k < N {
            nodes[k] = self.nodes[k].rounded();
            k += 1;
        }
        Tree {
            nodes,
            has_reversed: self.has_reversed,
            has_rotors: self.has_rotors,
            gravity: vector_to_f32(&self.gravity),
        }
    }
}

impl Node<f64> {
    /// Every number rounded to the nearest.
    pub(crate) const fn rounded(&self) -> Node<f32> {
        Node {
            kind: self.kind,
            is_reversed: self.is_reversed,
            inboard: self.inboard,
            is_branch: self.is_branch,
            limb: self.limb,
            twin: self.twin,
            position_start: self.position_start,
            velocity_start: self.velocity_start,
            offset: vector_to_f32(&self.offset),
            is_offset: self.is_offset,
            home_rotation: match &self.home_rotation {
                Some(m) => Some(matrix(m)),
                None => None,
            },
            home_axes: match &self.home_axes {
                Some(m) => Some(matrix(m)),
                None => None,
            },
            rotor_inertia: self.rotor_inertia as f32,
            inertia: RigidInertia {
                mass: self.inertia.mass as f32,
                first_moment: vector_to_f32(&self.inertia.first_moment),
                rotational: SymmetricMatrix3 {
                    diagonal: vector_to_f32(&self.inertia.rotational.diagonal),
                    off_diagonal: vector_to_f32(&self.inertia.rotational.off_diagonal),
                },
            },
            is_eccentric: self.is_eccentric,
            shape: self.shape,
            center: vector_to_f32(&self.center),
            body_rotation: match &self.body_rotation {
                Some(m) => Some(matrix(m)),
                None => None,
            },
        }
    }
}

/// Every number rounded to the nearest.
pub(crate) const fn vector_to_f32(v: &Vector3<f64>) -> Vector3<f32> {
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

//! What a tree knows of one body, in the body's own frame: for programs that build other models from it.

use super::{Axis, JointKind, Tree};
use crate::Real;
use nalgebra::{Matrix3, Vector3};

/// A body and where its joint sits in it. Body frame: origin at the centre of mass, axes as the
/// [`super::Link`] has them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyShape<T> {
    /// kg
    pub mass: T,
    /// About the centre of mass, kg·m².
    pub inertia: Matrix3<T>,
    /// The joint's point, m.
    pub joint: Vector3<T>,
    /// The joint's axis; zero for a joint that has none of its own.
    pub axis: Vector3<T>,
    /// Of the joint's rotor, reflected to the joint: kg·m², or kg where it slides.
    pub rotor_inertia: T,
}

impl<T: Real, const N: usize, const NQ: usize, const NV: usize> Tree<T, N, NQ, NV> {
    /// Body `k`, or `None` where there is no such body.
    pub fn body_shape(&self, k: usize) -> Option<BodyShape<T>> {
        let node = self.nodes.get(k)?;
        // Joint frame from body frame.
        let rotation = node.body_rotation.unwrap_or(Matrix3::identity());
        let c = node.center;
        let central = node.inertia.rotational.to_matrix()
            - (Matrix3::identity() * c.norm_squared() - c * c.transpose()) * node.inertia.mass;
        let axis = match node.kind {
            JointKind::Revolute(axis) | JointKind::Prismatic(axis) => match axis {
                Axis::X => Vector3::x(),
                Axis::Y => Vector3::y(),
                Axis::Z => Vector3::z(),
            },
            _ => Vector3::zeros(),
        };
        let axis = if node.is_reversed { -axis } else { axis };
        Some(BodyShape {
            mass: node.inertia.mass,
            inertia: rotation.tr_mul(&(central * rotation)),
            joint: -rotation.tr_mul(&c),
            axis: rotation.tr_mul(&axis),
            rotor_inertia: node.rotor_inertia,
        })
    }
}

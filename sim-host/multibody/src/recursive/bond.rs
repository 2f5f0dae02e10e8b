//! A free body that touches another, in the elimination: a leaf on a joint that holds nothing, with a
//! stiffness of its own in all six directions.
//!
//! # Notation
//! `S` the leaf's own stiffness, `K` that of the contact, `δ` the leaf's motion, `δ_a` that of the other body
//! carried to the leaf, `z` the impulse on the leaf.
//! ```text
//! S δ + K (δ − δ_a) = −z   ⇒   δ = A⁻¹ (K δ_a − z),  A = S + K                                   (1)
//! handed on:  z_a += K A⁻¹ z,  stiffness_a += K − K A⁻¹ K = K A⁻¹ S                                (2)
//! ```

use super::stiffness::{Pair, Stiffness};
use nalgebra::{Matrix6, Vector3, Vector6};

/// A leaf's eliminated equations.
#[derive(Clone, Debug)]
pub(super) struct Bond {
    /// The body that it touches.
    pub to: usize,
    /// From that body's reference point to the leaf's: at the beginning and at the end.
    pub arms: [Vector3<f64>; 2],
    /// `K`, `A⁻¹`.
    contact: Matrix6<f64>,
    inverse: Matrix6<f64>,
}

impl Bond {
    /// The bond, and the stiffness to hand on. None where `A` is singular.
    pub fn new(
        to: usize,
        arms: [Vector3<f64>; 2],
        leaf: &Stiffness,
        contact: &Stiffness,
    ) -> Option<(Self, Stiffness)> {
        let (leaf, contact) = (leaf.matrix(), contact.matrix());
        let inverse = (leaf + contact).try_inverse()?;
        let passed = Stiffness::of_matrix(&(contact * inverse * leaf));
        Some((Self { to, arms, contact, inverse }, passed))
    }

    /// `K A⁻¹ z`: what is handed on of an impulse on the leaf.
    pub fn passed(&self, impulse: &Pair) -> Pair {
        Pair::of_vector(&(self.contact * (self.inverse * impulse.vector())))
    }

    /// (1), from the impulse on the leaf and the motion of the other body's reference point.
    pub fn motion(&self, impulse: &Pair, other: &Pair) -> Pair {
        let linear = other.linear + other.angular.cross(&self.arms[1]);
        let carried = Pair { linear, angular: other.angular }.vector();
        let push: Vector6<f64> = self.contact * carried - impulse.vector();
        Pair::of_vector(&(self.inverse * push))
    }
}

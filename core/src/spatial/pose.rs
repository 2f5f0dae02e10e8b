//! Rigid-body transformations (Appendix A.4).

use super::{Twist, Wrench};
use crate::Real;
use nalgebra::{Matrix3, Vector3};

/// An element `g = (p, R)` of SE(3). As `pose_a_from_b` it maps coordinates in frame b to
/// coordinates in frame a; `p` is the origin of b in a (metres).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose<T> {
    /// `R`, columns are the axes of the second frame in the first.
    pub rotation: Matrix3<T>,
    /// `p` in metres.
    pub position: Vector3<T>,
}

impl<T: Real> Pose<T> {
    /// Both frames coincide.
    #[inline]
    pub fn identity() -> Self {
        Self { rotation: Matrix3::identity(), position: Vector3::zeros() }
    }

    /// `g_ac = g_ab g_bc`.
    #[inline]
    pub fn compose(&self, b_from_c: &Self) -> Self {
        Self {
            rotation: self.rotation * b_from_c.rotation,
            position: self.position + self.rotation * b_from_c.position,
        }
    }

    /// `g_ba` of `g_ab`.
    #[inline]
    pub fn inverse(&self) -> Self {
        let transposed = self.rotation.transpose();
        Self { rotation: transposed, position: -(transposed * self.position) }
    }

    /// A point given in the second frame, in the first.
    #[inline]
    pub fn transform_point(&self, point: Vector3<T>) -> Vector3<T> {
        self.position + self.rotation * point
    }

    /// `Ad_g V` (A.6): a twist of the second frame, expressed and taken at the first.
    #[inline]
    pub fn adjoint(&self, twist: Twist<T>) -> Twist<T> {
        let angular = self.rotation * twist.angular;
        Twist { linear: self.rotation * twist.linear + self.position.cross(&angular), angular }
    }

    /// `Ad_g⁻ᵀ F` (A.7): the wrench of the second frame, expressed and taken at the first,
    /// `[R 0; p̂R R] F`.
    #[inline]
    pub fn carry_wrench(&self, wrench: Wrench<T>) -> Wrench<T> {
        let force = self.rotation * wrench.force;
        Wrench { force, torque: self.rotation * wrench.torque + self.position.cross(&force) }
    }
}

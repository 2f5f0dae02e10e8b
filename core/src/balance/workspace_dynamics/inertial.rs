//! The wrench a body asks for, in frame 1's axes.
//!
//! # Notation
//! - `ω, α` angular velocity and acceleration, `a` acceleration of the joint's point less gravity
//! - `K = α̂ + ω̂ω̂`: a point at `r` from the joint accelerates by `a + K r` (1)
//! - `m, h, J` mass, first moment and inertia about the joint; `h` and `J` in joint-frame axes

use crate::Real;
use crate::model::{InertiaShape, Node};
use crate::spatial::Wrench;
use nalgebra::{Matrix3, Vector3};

/// `K r` of (1): `α × r + ω (ω·r) − r |ω|²`.
#[inline(always)]
pub(super) fn relative_acceleration<T: Real>(
    omega: Vector3<T>,
    alpha: Vector3<T>,
    r: Vector3<T>,
) -> Vector3<T> {
    alpha.cross(&r) + omega.cross(&omega.cross(&r))
}

/// `f = m a + K h`, `n = h × a + J α + ω × J ω`, at the joint.
#[inline(always)]
pub(in crate::balance) fn inertial_wrench<T: Real>(
    node: &Node<T>,
    rotation: &Matrix3<T>,
    omega: Vector3<T>,
    alpha: Vector3<T>,
    a: Vector3<T>,
) -> Wrench<T> {
    let inertia = &node.inertia;
    if node.shape == InertiaShape::Isotropic {
        // ω × Jω = 0, and J needs no axes.
        return Wrench { force: a * inertia.mass, torque: alpha * inertia.rotational.diagonal.x };
    }
    let (omega_b, alpha_b) = (rotation.tr_mul(&omega), rotation.tr_mul(&alpha));
    let torque = rotation * (node.rotational_product(alpha_b) + node.gyroscopic_torque(omega_b));
    if !node.is_eccentric {
        return Wrench { force: a * inertia.mass, torque };
    }
    let h = rotation * inertia.first_moment;
    Wrench {
        force: a * inertia.mass + relative_acceleration(omega, alpha, h),
        torque: torque + h.cross(&a),
    }
}

//! The law that turns a body upright and to a yaw.
//!
//! ```text
//! α = −k_d (ω − ω_d) − 2 k_p q_e,     q_e the vector part of q ⋆ q̄_d     (4.2.4 of the dissertation)
//! ```

use crate::Real;
use nalgebra::{Matrix3, Vector3};

/// Wanted angular acceleration, world axes, of a body with rotation `rotation` and angular velocity
/// `velocity` that is to be level, at the yaw `yaw` (rad), turning at `rate` (rad/s) about the vertical.
///
/// Within a tenth of a degree of half a turn from there the error is a little short.
pub(super) fn level<T: Real>(
    rotation: &Matrix3<T>,
    velocity: &Vector3<T>,
    (yaw, rate): (T, T),
    [stiffness, damping]: [T; 2],
) -> Vector3<T> {
    let (sine, cosine) = yaw.sine_cosine();
    // R R_dᵀ: the columns of R turned back about the vertical.
    let x = rotation.column(0) * cosine - rotation.column(1) * sine;
    let y = rotation.column(0) * sine + rotation.column(1) * cosine;
    let z = rotation.column(2);
    let trace = x.x + y.y + z.z;
    let skew = Vector3::new(y.z - z.y, z.x - x.z, x.y - y.x);
    let scalar = (T::one() + trace).max(T::zero()).sqrt() * T::of(0.5);
    // 2 q_e = skew/(2 s)
    let error = skew / (scalar.max(T::of(1e-3)) * T::of(2.0));
    let spin = velocity - Vector3::new(T::zero(), T::zero(), rate);
    -spin * damping - error * stiffness
}

//! Algorithm 4.4: the acceleration asked of the central body. The desired wrench is then
//! `F_1 = P_1 X + z_1` (4.3), by the form of workspace dynamics chosen.
//!
//! # Notation
//! Spatial frame unless marked `b`; `R = R_{0,1}`.
//! - `e_p = p − p_d`, `q_e` orientation error, `R_e` its matrix
//! - `ω_e = ω − R_e ω_d` (4.20)
//!
//! ```text
//! X_c = p̈_d − K_c^v ė_p − K_c^p e_p,     X_c^b = Rᵀ (X_c − ω × ṗ)                         (4.12)
//! X_R = R_e ω̇_d + ω × (R_e ω_d) − K_R^v ω_e − K_R^p q_e^v,   X_R^b = Rᵀ X_R               (4.24)
//! ```

use super::leg_kinematics::unit;
use super::{CentralBody, Fault, Gains, Input, Reference};
use crate::Real;
use crate::spatial::{Quaternion, Twist, orientation_error};
use nalgebra::Vector3;

/// The acceleration asked for, and the errors it comes from.
#[derive(Clone, Copy, Debug)]
pub struct DesiredAcceleration<T> {
    /// `X^b`: component derivative of the central body's twist, in its frame.
    pub x: Twist<T>,
    /// `e_p`, world frame, m.
    pub position_error: Vector3<T>,
    /// `q_e`, world frame, scalar part not negative.
    pub orientation_error: Quaternion<T>,
}

/// Alg. 4.4 up to `X^b`.
///
/// # Errors
/// [`Fault::NotUnit`] for the reference's quaternion.
#[inline(always)]
pub fn desired_acceleration<T: Real>(
    gains: &Gains<T>,
    central: &CentralBody<T>,
    position: Vector3<T>,
    reference: &Reference<T>,
) -> Result<DesiredAcceleration<T>, Fault> {
    let r = &central.rotation;
    let p_dot = r * central.velocity.linear;
    let omega = r * central.velocity.angular;

    let e_p = position - reference.position;
    let e_p_dot = p_dot - reference.velocity;
    let x_c =
        reference.acceleration - gains.velocity.product(e_p_dot) - gains.position.product(e_p);

    let q_d = unit(reference.orientation).ok_or(Fault::NotUnit(Input::Reference))?;
    let q_e = orientation_error(central.orientation, q_d);
    let omega_d = q_e.rotate(reference.angular_velocity);
    let omega_e = omega - omega_d;
    let x_r = q_e.rotate(reference.angular_acceleration) + omega.cross(&omega_d)
        - gains.angular_velocity.product(omega_e)
        - gains.orientation.product(q_e.v);

    Ok(DesiredAcceleration {
        x: Twist { linear: r.tr_mul(&(x_c - omega.cross(&p_dot))), angular: r.tr_mul(&x_r) },
        position_error: e_p,
        orientation_error: q_e,
    })
}

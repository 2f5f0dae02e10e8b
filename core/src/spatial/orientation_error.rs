//! Orientation error with the sign rule of §4.2.4.

use super::Quaternion;
use crate::Real;

/// `q_e = ± q ⋆ q̄_d` with non-negative scalar part, (4.17) and (4.18).
///
/// `q` and `q_d` are unit quaternions, both world from body. The error rotates the desired frame into
/// the measured one; its vector part is `sin(θ_e/2)` times a world-frame unit axis, with the angle
/// `θ_e` in [0, π].
///
/// `q` and `−q` stand for the same orientation and give the same error, so that the controller never
/// unwinds. At exactly half a turn both signs are right; there the sign is that of the first
/// non-zero component of the vector part, which again is the same for `q` and `−q`.
///
/// ```
/// use surefoot::spatial::{Quaternion, orientation_error};
/// let q = Quaternion::<f64>::from_array([0.0, 0.6, 0.8, 0.0]);
/// let minus_q = Quaternion::from_array([0.0, -0.6, -0.8, 0.0]);
/// let desired = Quaternion::from_array([0.8, 0.0, 0.0, 0.6]);
/// assert_eq!(orientation_error(q, desired), orientation_error(minus_q, desired));
/// ```
#[inline]
pub fn orientation_error<T: Real>(q: Quaternion<T>, q_desired: Quaternion<T>) -> Quaternion<T> {
    let q_et = q.product(q_desired.conjugate());
    let zero = T::zero();
    let sign_from = [q_et.s, q_et.v.x, q_et.v.y, q_et.v.z];
    let negative = sign_from.iter().find(|x| **x != zero).is_some_and(|x| *x < zero);
    if negative { Quaternion { s: -q_et.s, v: -q_et.v } } else { q_et }
}

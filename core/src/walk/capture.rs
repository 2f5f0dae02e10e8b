//! Where a robot would have to press to come to rest: the divergent component of its motion.
//!
//! ```text
//! ξ = c + v~/ω,     v~ = c' + (L_y, −L_x)/(m z)                                                  (1)
//! ```
//! `m z v~` is the horizontal momentum about the contact, divided by nothing that an inner motion changes:
//! a leg that is swung shakes `c'`, not `v~` (Gong and Grizzle, section II).

use crate::Real;
use crate::balance::ObservedMotion;
use nalgebra::Vector2;

/// (1): `ξ` in the world's plane, m, of a robot of mass `mass` (kg) whose centre of mass is at `height` (m)
/// above its contact, at the frequency `omega` (1/s).
pub fn capture_point<T: Real, const FEET: usize>(
    observed: &ObservedMotion<T, FEET>,
    mass: T,
    height: T,
    omega: T,
) -> Vector2<T> {
    let l = &observed.angular_momentum;
    let momentum = Vector2::new(l.y, -l.x) / (mass * height);
    observed.center_of_mass.xy() + (observed.velocity.xy() + momentum) / omega
}

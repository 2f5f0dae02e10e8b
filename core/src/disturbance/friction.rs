//! Dry friction in joints, where it is known.
//!
//! ```text
//! compensation   τ_f = σ c tanh((θ̇ + T θ̈_d)/v₀)                                  (1)
//! residual       τ − σ c tanh(θ̇/2v₀)                                             (2)
//! ```
//! `c` friction, `σ` the share of it that is compensated, `θ̈_d` the acceleration that is wanted: a joint
//! that is to start is helped before it moves. More than what there is makes a limit cycle, so σ is less
//! than one.

use crate::Real;

/// `T` of (1), s, and `v₀`, rad/s.
const LEAD: f64 = 0.05;
const WIDTH: f64 = 0.05;

/// (1), N·m: to be added to a joint's torque.
#[inline]
pub fn friction_compensation<T: Real>(friction: T, share: T, rate: T, acceleration: T) -> T {
    let v = rate + acceleration * T::of(LEAD);
    friction * share * (v / T::of(WIDTH)).tanh()
}

/// The last term of (2), N·m: what friction takes of a torque that was sent.
#[inline]
pub fn seen_friction<T: Real>(friction: T, share: T, rate: T) -> T {
    friction * share * (rate / T::of(2.0 * WIDTH)).tanh()
}

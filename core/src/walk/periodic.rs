//! The gait that repeats itself.
//!
//! While a side stands, the centre of pressure rests in its point and `ξ` leaves it as
//! `e(t) = e(0) exp(ω t)`; in double support it goes from the old point to the new one at a constant rate. With
//! the step `u` and offsets that repeat from step to step (forwards), or with the sign of the side
//! (sideways), that gives, from the old point at touch-down (a) and from the new one at lift-off (b):
//!
//! ```text
//! κ = (E_d − 1)/(ω T_d)
//! b = E_d a − κ u                                                       (1)  double support
//! a = E_s b                                                             (2)  single support, of the next step
//! a_f = E_s κ u_f/(E_s E_d − 1),      b_f =  a_f/E_s                     (3)  forward part: (1), (2)
//! a_l = E_s κ u_l/(1 + E_s E_d),      b_l = −a_l/E_s                     (4)  part that alternates
//! ```
//! (1) is Englsberger's (section V) with a linear centre of pressure, `b` Khadiv's offset. A commanded lateral
//! velocity is in (3), the step in place `u_l = −s W` in (4).

use super::{Gait, Side};
use crate::Real;
use nalgebra::Vector2;

/// A step of the gait that repeats itself; heading frame, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PeriodicStep<T> {
    /// `u`: from the stance point to the next one.
    pub step: Vector2<T>,
    /// `a`: capture point at touch-down from the old stance point.
    pub at_touch_down: Vector2<T>,
    /// `b`: capture point when the old side lifts, from the new stance point.
    pub at_lift_off: Vector2<T>,
    /// `κ`
    pub kappa: T,
    /// `E_d`
    pub growth: T,
}

/// (3) and (4) for a stance on `side` and a wanted `velocity` (forward and left, m/s).
pub fn periodic_step<T: Real>(gait: &Gait<T>, side: Side, velocity: Vector2<T>) -> PeriodicStep<T> {
    let single = (gait.omega * gait.single).exp();
    let double = (gait.omega * gait.double).exp();
    let kappa = (double - T::one()) / (gait.omega * gait.double);
    let onward = velocity * (gait.single + gait.double);
    let across = Vector2::new(T::zero(), -side.sign::<T>() * gait.width);
    let a_onward = onward * (single * kappa / (single * double - T::one()));
    let a_across = across * (single * kappa / (single * double + T::one()));
    PeriodicStep {
        step: onward + across,
        at_touch_down: a_onward + a_across,
        at_lift_off: (a_onward - a_across) / single,
        kappa,
        growth: double,
    }
}

impl<T: Real> PeriodicStep<T> {
    /// The step that leaves the offset `b` for a capture point `a` at touch-down: (1) for `u`.
    pub(super) fn step_for(&self, a: Vector2<T>) -> Vector2<T> {
        (a * self.growth - self.at_lift_off) / self.kappa
    }

    /// By how much a step `u` misses the offset: (1) for `b`, less what is wanted.
    pub(super) fn miss(&self, a: Vector2<T>, u: Vector2<T>) -> Vector2<T> {
        a * self.growth - u * self.kappa - self.at_lift_off
    }

    /// The capture point at touch-down that a step `u` wants: (1) for `a`.
    pub(super) fn touch_down_for(&self, u: Vector2<T>) -> Vector2<T> {
        (u * self.kappa + self.at_lift_off) / self.growth
    }
}

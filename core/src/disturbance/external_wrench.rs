//! The wrench that acts on the central body from outside: a load, a centre of mass that is elsewhere, a
//! hand that leans on it.
//!
//! # Notation
//! World axes, about the central body's centre of mass.
//! ```text
//! w = r_base − Σ_{feet that stand} (F_i, p_i × F_i + M_i)                        (1)
//! W ← W + κ Δ clip(w − W),   |W| ≤ bound                                         (2)
//! ```
//! Innovations are clipped, so that a push moves W by little. Where all have come to rest, W rests too
//! until one changes by more than the *dead zone*: joints that stick hold the robot where it is, whatever
//! its torques try, and read as a wrench that follows W about.

use super::{FootForce, ObserverFault};
use crate::Real;
use crate::spatial::Wrench;

/// How (2) goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExternalWrenchSettings<T> {
    /// `κ`, 1/s.
    pub rate: T,
    /// Greatest innovations, force before moment, N and N·m.
    pub innovation: [T; 6],
    /// Greatest `|W|`.
    pub bound: [T; 6],
    /// By how much an innovation has to change for W to leave its rest. Zeros: it has none.
    pub dead_zone: [T; 6],
    /// Time after which W rests, come to rest or not, s.
    pub patience: T,
}

/// An innovation this small, in dead zones, has come to rest.
const AT_REST: f64 = 0.03;

impl<T: Real> ExternalWrenchSettings<T> {
    /// Documented starting values for a mass (kg) under gravity (m/s²) whose central body is at the height
    /// `z` (m) above its feet. In shares of `m g`, and of `m g z` for moments: innovations of 0.04, vertical
    /// 0.14; bounds of twice and three times that; dead zones of 0.004, 0.014 and moments of 0.003. For 75 kg
    /// and 1 m these are 30 N, 100 N, 30 N·m; 60 N, 300 N, 60 N·m; 3 N, 10 N, 2 N·m.
    ///
    /// # Errors
    /// [`ObserverFault::Robot`] where a number is not positive and finite.
    pub fn scaled(mass: T, gravity: T, height: T) -> Result<Self, ObserverFault> {
        let weight = mass * gravity;
        if !(weight > T::zero() && height > T::zero() && (weight * height).is_finite()) {
            return Err(ObserverFault::Robot);
        }
        let shares = |flat: f64, vertical: f64, moment: f64| {
            let (flat, vertical) = (weight * T::of(flat), weight * T::of(vertical));
            let moment = weight * height * T::of(moment);
            [flat, flat, vertical, moment, moment, moment]
        };
        Ok(Self {
            rate: T::of(2.0),
            innovation: shares(0.04, 0.14, 0.04),
            bound: shares(0.08, 0.42, 0.08),
            dead_zone: shares(0.004, 0.014, 0.003),
            patience: T::of(4.0),
        })
    }

    /// Whether every number can be, at a period (s).
    ///
    /// # Errors
    /// [`ObserverFault::Rate`], [`ObserverFault::Bound`].
    pub fn check(&self, period: T) -> Result<(), ObserverFault> {
        let gain = self.rate * period;
        if !(gain >= T::zero() && gain <= T::one()) {
            return Err(ObserverFault::Rate);
        }
        let all = self.innovation.iter().chain(&self.bound).chain(&self.dead_zone);
        let is_good = all.chain([&self.patience]).all(|x| *x >= T::zero());
        if is_good { Ok(()) } else { Err(ObserverFault::Bound) }
    }
}

/// `W`, and whether it rests.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExternalWrench<T> {
    /// `W`, world axes, about the central body's centre of mass, N and N·m.
    pub wrench: Wrench<T>,
    /// The innovation at which it came to rest, while it rests.
    pub at_rest: Option<Wrench<T>>,
    /// For how long it has not rested, s.
    pub awake: T,
}

impl<T: Real> ExternalWrench<T> {
    /// Nothing acts.
    pub fn new() -> Self {
        Self { wrench: Wrench::zero(), at_rest: None, awake: T::zero() }
    }

    /// (2) for `w` after a period (s).
    #[inline(always)]
    pub fn update(&mut self, settings: &ExternalWrenchSettings<T>, w: Wrench<T>, period: T) {
        let innovation = w - self.wrench;
        let change = innovation - self.at_rest.unwrap_or(Wrench::zero());
        let share = if self.at_rest.is_some() { T::one() } else { T::of(AT_REST) };
        let within = |(x, zone): (T, &T)| x.abs() <= *zone * share;
        if change.to_array().into_iter().zip(&settings.dead_zone).all(within) {
            self.awake = T::zero();
            self.at_rest = self.at_rest.or(Some(innovation));
            return;
        }
        if self.at_rest.take().is_some() {
            self.awake = T::zero();
        }
        self.awake += period;
        let has_zone = settings.dead_zone.iter().any(|zone| *zone > T::zero());
        if has_zone && self.awake > settings.patience {
            self.at_rest = Some(innovation);
            self.awake = T::zero();
            return;
        }
        let mut next = self.wrench.to_array();
        let limits = settings.innovation.iter().zip(&settings.bound);
        for ((x, innovation), (most, bound)) in
            next.iter_mut().zip(innovation.to_array()).zip(limits)
        {
            let step = innovation.max(-*most).min(*most) * settings.rate * period;
            *x = (*x + step).max(-*bound).min(*bound);
        }
        self.wrench = Wrench::from_array(next);
    }
}

impl<T: Real> Default for ExternalWrench<T> {
    fn default() -> Self {
        Self::new()
    }
}

/// (1) for the residual's rows of the central body.
#[inline(always)]
pub(super) fn unexplained<T: Real, const FEET: usize>(
    base: Wrench<T>,
    feet: &[Option<FootForce<T>>; FEET],
    standing: &[bool; FEET],
) -> Wrench<T> {
    let mut w = base;
    for (foot, stands) in feet.iter().zip(standing) {
        if let Some(FootForce { wrench, position }) = foot.as_ref().filter(|_| *stands) {
            w -= wrench.shifted(*position);
        }
    }
    w
}

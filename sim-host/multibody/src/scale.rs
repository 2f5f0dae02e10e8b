//! What the residuals of a step's equations are measured by.
//!
//! # Notation
//! `c` a generalized velocity with its momentum equation, `r` that equation's residual, `q̇` the rate in the last step,
//! `J` the composite inertia: of all that moves with it, kg or kg·m²; `f, ℓ` other impulses of a step on a body of mass
//! `m` and moment of inertia `I`; `b` a generalized velocity that moves a whole free tree.
//! ```text
//! ‖r‖² = Σ r_c²/J_c                                                                        (1)
//! S²   = Σ_{c≠b} J_c q̇_c² + Σ f²/m + Σ ℓ²/I                  of weights, motors and springs  (2)
//! R²   = S² + Σ_b J_b q̇_b² + Σ f²/m + Σ ℓ²/I                 of floors, loops, cancelled terms (3)
//! error = (‖r‖ − 2e-15 R)/(S + 1e-4 R)                                                     (4)
//! ```
//! All of these are roots of twice an energy, so that equations of any kind and size can be added up, in (1) each with
//! an inertia of its own. With `J` not below the inertia in any position, `|Σ_d M_cd q̇_d| ≤ √(n J_c) √(Σ J_d q̇_d²)`
//! for `n` velocities: `√J_c R` bounds what is added up in an equation, and its round-off is `ε √J_c R` whatever
//! cancels there. `S` is the motion that has to be right: it knows no drift of the whole, and does not vanish where a
//! body only spins, or rests between forces. Both come from the state that the step begins with, and not from trials;
//! only the forces of floors do not, of which no more than round-off counts.

use super::stepping::ROUND_OFF;
use super::system::System;
use nalgebra::Vector3;

/// Share of what is added up in the equations that counts as motion: with the tolerance of Newton's method, 1e-10,
/// some 50 round-offs.
const ROUGH: f64 = 1e-4;
/// Least share of a body's largest moment of inertia that is taken as one about some axis: about a thinner one
/// round-off of the others has the last word.
const THINNEST: f64 = 1e-6;

/// `S²` and `R² − S²`, kg·m²/s².
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Scale {
    pub motion: f64,
    pub terms: f64,
}

impl Scale {
    /// (4), for `‖r‖²`. NaN stays NaN.
    #[inline]
    pub fn relative(&self, residual: f64) -> f64 {
        let (motion, terms) = (self.motion.sqrt(), (self.motion + self.terms).sqrt());
        beyond(residual.sqrt(), terms, motion)
    }
}

/// What is left of a residual beyond the round-off of its terms, against a motion and these terms. NaN stays NaN.
#[inline]
pub(super) fn beyond(residual: f64, terms: f64, motion: f64) -> f64 {
    let beyond = residual - ROUND_OFF * terms;
    if beyond <= 0.0 { 0.0 } else { beyond / (motion + ROUGH * terms) }
}

/// Masses along paths that lead away from a point, m: `Σ m`, `Σ m s` and `Σ m s²`. Their ends are not farther away.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Composite {
    pub mass: f64,
    first: f64,
    /// Not below any moment of inertia about the point, kg·m².
    pub moment: f64,
}

impl Composite {
    /// A body with its centre of mass `arm` away, and its largest moment of inertia.
    pub fn of_body(mass: f64, inertia: f64, arm: f64) -> Self {
        let moment = mass * arm * arm + inertia;
        Self { mass, first: (mass * moment).sqrt(), moment }
    }

    /// The same seen from a point `by` farther away.
    pub fn seen_from(&self, by: f64) -> Self {
        let Self { mass, first, moment } = *self;
        Self { mass, first: first + mass * by, moment: moment + by * (2.0 * first + mass * by) }
    }

    pub fn add(&mut self, other: &Self) {
        self.mass += other.mass;
        self.first += other.first;
        self.moment += other.moment;
    }
}

/// How far from the origin, m: not less than a vector's length, nor twice of it.
#[inline]
pub(super) fn away(p: &Vector3<f64>) -> f64 {
    p.x.abs() + p.y.abs() + p.z.abs()
}

/// Of the rotors in the joint of a link, kg·m², or kg.
pub(super) fn rotor_inertia(system: &System, link: usize) -> f64 {
    let own = system.laws().iter().filter(|(k, _)| *k == link);
    own.map(|(_, law)| law.rotor_inertia).sum()
}

/// A moment of inertia about some axis as it is measured by, next to the largest one.
pub(super) fn not_too_thin(inertia: f64, largest: f64) -> f64 {
    inertia.max(THINNEST * largest)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A mass on the end of two arms, straight: `m (a + b)²`.
    #[test]
    fn composites_reach_to_the_ends() {
        let body = Composite::of_body(2.0, 0.0, 0.5).seen_from(1.5);
        assert_eq!((body.mass, body.moment), (2.0, 8.0));
    }

    #[test]
    fn nothing_is_measured_by_nothing_and_nan_is_seen() {
        let nothing = Scale::default();
        assert_eq!(nothing.relative(0.0), 0.0);
        assert_eq!(nothing.relative(1e-40), f64::INFINITY);
        assert!(Scale { motion: 1.0, terms: 1.0 }.relative(f64::NAN).is_nan());
        assert!(Scale { motion: f64::NAN, terms: 1.0 }.relative(1.0).is_nan());
        // Round-off beside large terms is none; beside small ones it is an error.
        assert_eq!(Scale { motion: 1.0, terms: 1e20 }.relative(1e-12), 0.0);
        assert!(Scale { motion: 1.0, terms: 0.0 }.relative(1e-12) > 9e-7);
    }
}

//! Springs, dampers, friction, stops and rotors in joints.

use serde::{Deserialize, Serialize};

/// What a joint has of its own: the torque (or force, if it slides) of a spring, a damper, dry friction, and stops that
/// yield; and the inertia of its motor.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct JointLaw {
    /// N·m/rad, or N/m.
    pub stiffness: f64,
    /// Where the spring is at rest, rad or m.
    pub rest: f64,
    /// N·m·s/rad, or N·s/m.
    pub damping: f64,
    /// Dry friction, N·m or N: against the motion, `f ω/√(ω² + ω₀²)` with `ω₀` = [`CREEP`], so that a joint under load
    /// creeps instead of resting.
    pub friction: f64,
    /// Ends of the joint's way.
    pub stops: Option<Stops>,
    /// Of motor and gear, reflected to the joint, kg·m², or kg: it adds `½ I θ̇²` to the kinetic energy, as `core`'s
    /// `Link::rotor_inertia` does.
    pub rotor_inertia: f64,
}

/// Ends of a joint's way: springs that press only outside of it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stops {
    /// rad or m
    pub low: f64,
    /// rad or m
    pub high: f64,
    /// N·m/rad or N/m
    pub stiffness: f64,
}

impl Stops {
    /// How far beyond a stop the joint is, with its sign; zero between them.
    pub fn beyond(&self, x: f64) -> f64 {
        (x - self.high).max(0.0) + (x - self.low).min(0.0)
    }
}

/// Rate at which friction has 0.7 of its torque, rad/s or m/s.
pub const CREEP: f64 = 0.01;

impl JointLaw {
    /// Of nothing.
    pub const NONE: Self = Self {
        stiffness: 0.0,
        rest: 0.0,
        damping: 0.0,
        friction: 0.0,
        stops: None,
        rotor_inertia: 0.0,
    };

    /// Whether all its numbers can be used.
    pub fn is_valid(&self) -> bool {
        let fine = |x: f64| x.is_finite() && x >= 0.0;
        let stops = self.stops.is_none_or(|s| {
            fine(s.stiffness) && s.low.is_finite() && s.high.is_finite() && s.low < s.high
        });
        let sizes = [self.stiffness, self.damping, self.friction, self.rotor_inertia];
        sizes.into_iter().all(fine) && self.rest.is_finite() && stops
    }

    /// Torque over a step from `a` to `b`, and its derivative with respect to `b`. Springs and stops give
    /// the mean slope of their energy over the step (Gonzalez' discrete gradient), so that what they
    /// give back is what they took, whatever the step.
    pub fn over_step(&self, a: f64, way: f64, h: f64) -> (f64, f64) {
        let b = a + way;
        let mut torque = -self.stiffness * (0.5 * (a + b) - self.rest) - self.damping * way / h;
        let mut slope = -0.5 * self.stiffness - self.damping / h;
        if self.friction != 0.0 {
            let (rubbed, rubbed_slope) = self.rubbed(way / h);
            torque -= rubbed;
            slope -= rubbed_slope / h;
        }
        if let Some(stops) = self.stops {
            let (from, to) = (stops.beyond(a), stops.beyond(b));
            let k = stops.stiffness;
            if from != 0.0 && to != 0.0 && (from > 0.0) == (to > 0.0) {
                torque -= 0.5 * k * (from + to);
                slope -= 0.5 * k;
            } else if way != 0.0 {
                let mean = 0.5 * k * (to * to - from * from) / way;
                torque -= mean;
                slope -= (k * to - mean) / way;
            }
        }
        (torque, slope)
    }

    /// What its torque over a step is a sum of, in absolute values: springs' and dampers' may cancel.
    pub(super) fn terms(&self, a: f64, way: f64, h: f64) -> f64 {
        let at = a.abs() + way.abs();
        let spring = self.stiffness * (at + self.rest.abs()) + (self.damping * way / h).abs();
        let stop = self.stops.filter(|stops| stops.beyond(a) != 0.0);
        spring
            + self.friction
            + stop.map_or(0.0, |s| s.stiffness * (at + s.low.abs().max(s.high.abs())))
    }

    /// Friction at a rate, against it, and its derivative.
    pub fn rubbed(&self, rate: f64) -> (f64, f64) {
        let x = rate / CREEP;
        let root = (1.0 + x * x).sqrt();
        (self.friction * x / root, self.friction / (CREEP * root * root * root))
    }

    /// Whether it takes energy.
    pub fn dissipates(&self) -> bool {
        self.damping != 0.0 || self.friction != 0.0
    }

    /// Momentum of the rotor over a step, that of `½ I (way/h)² h` at either end, and its derivative with respect to
    /// the way.
    pub(super) fn rotor(&self, way: f64, h: f64) -> (f64, f64) {
        let slope = self.rotor_inertia / h;
        (slope * way, slope)
    }

    /// Energy held at `x`, J.
    pub fn energy(&self, x: f64) -> f64 {
        let spring = 0.5 * self.stiffness * (x - self.rest).powi(2);
        spring
            + self.stops.map_or(0.0, |stops| {
                let beyond = stops.beyond(x);
                0.5 * stops.stiffness * beyond * beyond
            })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAW: JointLaw = JointLaw {
        stiffness: 3.0,
        rest: 0.2,
        stops: Some(Stops { low: -0.5, high: 0.5, stiffness: 40.0 }),
        ..JointLaw::NONE
    };

    /// For every pair of ends the work done is the energy lost.
    #[test]
    fn springs_and_stops_give_back_what_they_took() {
        for a in [-0.9, -0.5, 0.0, 0.49, 0.6, 0.8] {
            for b in [-0.8, -0.51, 0.1, 0.5, 0.7] {
                let (torque, _) = LAW.over_step(a, b - a, 0.01);
                let lost = LAW.energy(a) - LAW.energy(b);
                assert!((torque * (b - a) - lost).abs() < 1e-14, "{a} {b}");
            }
        }
    }

    #[test]
    fn slopes_are_derivatives() {
        let law = JointLaw { damping: 0.7, friction: 0.4, ..LAW };
        for a in [-0.9, 0.0, 0.6] {
            for way in [-1.3, -0.2, 0.01, 0.3, 0.9] {
                let at = |way| law.over_step(a, way, 0.01).0;
                let (_, slope) = law.over_step(a, way, 0.01);
                let differences = (at(way + 1e-6) - at(way - 1e-6)) / 2e-6;
                assert!((slope - differences).abs() < 1e-5 * slope.abs(), "{a} {way}");
            }
        }
    }

    #[test]
    fn bad_numbers_are_seen() {
        assert!(LAW.is_valid());
        assert!(!JointLaw { damping: -1.0, ..LAW }.is_valid());
        assert!(!JointLaw { rest: f64::NAN, ..LAW }.is_valid());
        let crossed = Stops { low: 1.0, high: -1.0, stiffness: 1.0 };
        assert!(!JointLaw { stops: Some(crossed), ..LAW }.is_valid());
    }
}

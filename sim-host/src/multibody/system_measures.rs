//! What can be measured of a system's state: energy, momentum, constraints.

use super::body::BodyState;
use super::system::{System, WORLD};

impl System {
    /// Kinetic and potential energy, J.
    pub fn energy(&self, states: &[BodyState], rates: &[BodyState]) -> f64 {
        let each = self.links().iter().zip(states).zip(rates);
        each.map(|((link, x), v)| link.body.energy(x, v, self.gravity())).sum()
    }

    /// Linear and angular momentum about the world's origin: N·s, N·m·s.
    pub fn momentum(&self, states: &[BodyState], rates: &[BodyState]) -> ([f64; 3], [f64; 3]) {
        let mut sum = ([0.0; 3], [0.0; 3]);
        for ((link, x), v) in self.links().iter().zip(states).zip(rates) {
            let (linear, angular) = link.body.momentum(x, v);
            for i in 0..3 {
                sum.0[i] += linear[i];
                sum.1[i] += angular[i];
            }
        }
        sum
    }

    /// Largest constraint, of joints and quaternions.
    pub fn largest_constraint(&self, states: &[BodyState]) -> f64 {
        let mut largest = 0.0_f64;
        for (link, x) in self.links().iter().zip(states) {
            let inboard = link.inboard.map_or(&WORLD, |inboard| &states[inboard]);
            for g in link.joint.evaluate(x, inboard) {
                largest = largest.max(g.abs());
            }
            largest = largest.max((x[3..].iter().map(|q| q * q).sum::<f64>() - 1.0).abs());
        }
        for closure in self.closures() {
            for g in closure.at(states).error {
                largest = largest.max(g.abs());
            }
        }
        largest
    }
}

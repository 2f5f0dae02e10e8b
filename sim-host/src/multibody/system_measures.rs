//! What can be measured of a system's state: energy, momentum, constraints.

use super::body::BodyState;
use super::closure::Closing;
use super::joint::Joint;
use super::system::{System, WORLD};

impl System {
    /// Kinetic energy, and potential energy of gravity and of joints' springs and stops, J; not that of contacts.
    /// `angle` tells where the joint of a link is, rad or m: of what turns more than once, states do not.
    pub fn energy(
        &self,
        states: &[BodyState],
        rates: &[BodyState],
        angle: impl Fn(usize) -> f64,
    ) -> f64 {
        let each = self.links().iter().zip(states).zip(rates);
        let of_bodies = each.map(|((link, x), v)| link.body.energy(x, v, self.gravity()));
        of_bodies.sum::<f64>() + self.energy_in_joints(angle)
    }

    /// Kinetic energy, J.
    pub fn kinetic_energy(&self, states: &[BodyState], rates: &[BodyState]) -> f64 {
        let each = self.links().iter().zip(states).zip(rates);
        each.map(|((link, x), v)| link.body.energy(x, v, 0.0)).sum()
    }

    /// Energy that joints' springs and stops hold, J, with the joint of each link where `angle` tells.
    pub fn energy_in_joints(&self, angle: impl Fn(usize) -> f64) -> f64 {
        self.laws().iter().map(|(link, law)| law.energy(angle(*link))).sum()
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

    /// Length of all arms together, of joints that close loops too, and of bodies' radii of gyration, m.
    pub(super) fn length(&self) -> f64 {
        let size = |arm: &[f64; 3]| arm.iter().map(|x| x * x).sum::<f64>().sqrt();
        // Where a joint is in the world is no arm.
        let arms = |joint: &Joint, inboard: Option<usize>| {
            size(&joint.outboard) + inboard.map_or(0.0, |_| size(&joint.inboard))
        };
        let in_tree = self.links().iter().map(|link| {
            let largest = link.body.inertia.iter().fold(0.0_f64, |m, i| m.max(*i));
            arms(&link.joint, link.inboard) + (largest / link.body.mass).sqrt()
        });
        let closing = self.closures().iter().map(|closure| match &closure.closing {
            Closing::Joint(joint) => arms(joint, closure.inboard),
            Closing::General(_) => 0.0,
        });
        in_tree.chain(closing).sum()
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

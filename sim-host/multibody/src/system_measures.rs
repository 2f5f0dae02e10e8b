//! What can be measured of a system's state: energy, momentum, constraints, joints' rates.

use super::body::{BodyState, cross, split};
use super::closure::Closing;
use super::joint::{Joint, JointConstraint, rotated};
use super::system::{System, WORLD};
use surefoot_mechanics::systems::FreeRigidBody;

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
        of_bodies.sum::<f64>() + self.rotor_energy(states, rates) + self.energy_in_joints(angle)
    }

    /// Kinetic energy, J.
    pub fn kinetic_energy(&self, states: &[BodyState], rates: &[BodyState]) -> f64 {
        let each = self.links().iter().zip(states).zip(rates);
        let of_bodies = each.map(|((link, x), v)| link.body.energy(x, v, 0.0));
        of_bodies.sum::<f64>() + self.rotor_energy(states, rates)
    }

    /// Kinetic energy of joints' rotors, J.
    fn rotor_energy(&self, states: &[BodyState], rates: &[BodyState]) -> f64 {
        let rotors = self.laws().iter().filter(|(_, law)| law.rotor_inertia != 0.0);
        let each = rotors
            .map(|(link, law)| law.rotor_inertia * self.joint_rate(*link, states, rates).powi(2));
        0.5 * each.sum::<f64>()
    }

    /// Rate of a joint of one coordinate, rad/s or m/s; zero for others.
    pub(super) fn joint_rate(&self, link: usize, states: &[BodyState], rates: &[BodyState]) -> f64 {
        let Joint { outboard, inboard, constraint, .. } = &self.links()[link].joint;
        let at = |link: Option<usize>| match link {
            Some(k) => (&states[k], &rates[k]),
            None => (&WORLD, &[0.0; 7]),
        };
        let bodies = [at(Some(link)), at(self.links()[link].inboard)];
        let [o, i] = bodies.map(|(x, v)| Turning::of(x, v));
        let along = |axis: [f64; 3], v: [f64; 3]| (0..3).map(|n| axis[n] * v[n]).sum();
        match constraint {
            JointConstraint::Revolute { axis } => {
                let apart = std::array::from_fn(|n| o.omega[n] - i.omega[n]);
                along(rotated(&o.q, axis), apart)
            }
            JointConstraint::Prismatic { axis } => {
                let [v_o, v_i] = [o.velocity(outboard), i.velocity(inboard)];
                along(rotated(&i.q, axis), std::array::from_fn(|n| v_o[n] - v_i[n]))
            }
            _ => 0.0,
        }
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

/// A body that turns, world axes.
struct Turning {
    q: [f64; 4],
    omega: [f64; 3],
    v: [f64; 3],
}

impl Turning {
    fn of(x: &BodyState, rate: &BodyState) -> Self {
        let (_, q) = split(x);
        let (v, q_dot) = split(rate);
        let own = FreeRigidBody::angular_velocity(&q, &q_dot);
        Self { q, omega: rotated(&q, &own), v }
    }

    /// Of a point in the body.
    fn velocity(&self, point: &[f64; 3]) -> [f64; 3] {
        let by_turning = cross(&self.omega, &rotated(&self.q, point));
        std::array::from_fn(|n| self.v[n] + by_turning[n])
    }
}

//! Velocities and energies of a planar motion, from momenta; and its bodies in space.

use super::super::body::BodyState;
use super::algebra::{Pair, Rotation, Turn, quarter};
use super::node::Kind;
use super::simulation::PlanarSimulation;
use nalgebra::Vector3;
use surefoot::spatial::Quaternion;
use surefoot_mechanics::integrators::{StepError, StepFailure};
use surefoot_mechanics::newton::NewtonFailure;

impl PlanarSimulation {
    /// Velocities that belong to the momentum, by column, into `corrections`: about the plane's normal, rad/s, or
    /// along an axis, m/s.
    pub(super) fn column_rates(&mut self) -> Result<(), StepError> {
        // For a step of no length impulses are momenta, and motions are velocities.
        let h = self.at.progress.h;
        for (end, place) in self.ends.iter_mut().zip(&self.places) {
            end.turn = Turn::NONE;
            end.rotation = Rotation::NONE;
            end.to_center = place.to_center;
            end.from_inboard = place.from_inboard;
            end.axis = place.axis;
        }
        self.touches.iter_mut().for_each(super::touch::Touch::forget);
        self.own_slopes.fill(0.0);
        for law in &self.laws {
            self.own_slopes[law.column] -= law.law.rotor(0.0, h).1;
        }
        let Self { elimination, nodes, places, ends, touches, own_slopes, at, .. } = self;
        elimination.factor(nodes, places, ends, touches, own_slopes, h).map_err(|pivot| {
            at.progress.error(StepFailure::Newton(NewtonFailure::SingularJacobian { pivot }))
        })?;
        let momenta = &at.momenta;
        elimination.solve(nodes, places, |_| Pair::ZERO, |c| momenta[c], &mut self.corrections);
        self.corrections.iter_mut().for_each(|x| *x /= h);
        Ok(())
    }

    /// A body's state.
    pub fn state(&self, link: usize) -> BodyState {
        let (place, beside) = (&self.places[link], &self.beside[link]);
        let n = &self.plane.normal;
        let center = self.plane.told(&(place.reference + place.to_center)) + n * beside.along;
        let Turn { c, s } = self.turn(link);
        let q = Quaternion { s: c, v: n * s }.product(beside.orientation).to_array();
        [center.x, center.y, center.z, q[0], q[1], q[2], q[3]]
    }

    /// All bodies' states.
    pub fn states(&self) -> Vec<BodyState> {
        (0..self.nodes.len()).map(|k| self.state(k)).collect()
    }

    /// All bodies' rates that belong to the momentum.
    ///
    /// # Errors
    /// A [`StepError`] where the inertia is singular.
    pub fn rates(&mut self) -> Result<Vec<BodyState>, StepError> {
        self.column_rates()?;
        let mut motions: Vec<Pair> = Vec::with_capacity(self.nodes.len());
        let rates = (0..self.nodes.len()).map(|k| {
            let (node, place) = (&self.nodes[k], &self.places[k]);
            let mut motion = node.inboard.map_or(Pair::ZERO, |i| {
                let Pair { linear, angular } = motions[i];
                Pair { linear: linear + quarter(&place.from_inboard) * angular, angular }
            });
            let by = &self.corrections[node.column..];
            match node.kind {
                Kind::Fixed => {}
                Kind::Revolute => motion.angular += by[0],
                Kind::Prismatic => motion.linear += place.axis * by[0],
                Kind::Floating => {
                    motion.linear.x += by[0];
                    motion.linear.y += by[1];
                    motion.angular += by[2];
                }
            }
            motions.push(motion);
            let v = self.plane.told(&(motion.linear + quarter(&place.to_center) * motion.angular));
            let [_, _, _, s, x, y, z] = self.state(k);
            let omega = Quaternion { s: 0.0, v: self.plane.normal * (0.5 * motion.angular) };
            let q = omega.product(Quaternion { s, v: Vector3::new(x, y, z) }).to_array();
            [v.x, v.y, v.z, q[0], q[1], q[2], q[3]]
        });
        Ok(rates.collect())
    }

    /// Kinetic energy, and potential energy of gravity and of all springs, J.
    ///
    /// # Errors
    /// As for [`Self::rates`].
    pub fn energies(&mut self) -> Result<(f64, f64), StepError> {
        self.column_rates()?;
        let along: f64 = self.corrections.iter().zip(&self.at.momenta).map(|(v, p)| v * p).sum();
        let gravity = self.system.gravity();
        let weight: f64 = self
            .nodes
            .iter()
            .enumerate()
            .map(|(k, node)| node.mass * gravity * self.state(k)[2])
            .sum();
        let angle = |link| {
            let mut each = self.laws.iter().zip(&self.at.angles);
            each.find(|(law, _)| law.node == link).map_or(0.0, |(_, angle)| *angle)
        };
        let in_joints = self.system.energy_in_joints(angle);
        let mut in_floor = 0.0;
        if let Some((floor, _)) = self.system.ground() {
            for (node, place) in self.nodes.iter().zip(&self.places) {
                let center = place.reference + place.to_center;
                let touches = &self.touches[node.touches.clone()];
                for (touch, memory) in touches.iter().zip(&self.at.memories[node.touches.clone()]) {
                    let p = center + place.rotation.rotate(&touch.arm);
                    in_floor += touch.spring_energy(floor, memory, &p);
                }
            }
        }
        Ok((0.5 * along, weight + in_joints + in_floor))
    }
}

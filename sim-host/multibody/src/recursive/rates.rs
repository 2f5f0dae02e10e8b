//! Velocities and energies, from momenta.

use super::super::body::BodyState;
use super::coordinates::Increment;
use super::equations::singular;
use super::node::Place;
use super::simulation::Simulation;
use super::stiffness::Pair;
use super::strike::Strike;
use super::turn::Turn;
use nalgebra::{Matrix3, Vector3};
use surefoot_mechanics::integrators::StepError;

impl Simulation {
    /// Velocities that belong to the momentum, by column: of joints, rad/s or m/s; of a floating body, of
    /// its centre of mass and its angular velocity, world frame.
    ///
    /// # Errors
    /// A [`StepError`] where the inertia is singular.
    pub fn column_rates(&mut self) -> Result<&[f64], StepError> {
        let momenta = std::mem::take(&mut self.at.momenta);
        let result = self.answer_to(&momenta);
        self.at.momenta = momenta;
        result?;
        Ok(&self.corrections)
    }

    /// Velocities by column from the last two steps' mean ones, carried on to now; before the first step,
    /// those of the start. They are of the method's order like those that belong to the momentum. Where a
    /// stiff damper holds a joint, as the floor holds a foot, the momentum swings to and fro about them: this
    /// is what encoders see. Of a spherical joint with motors they are the motors' rates.
    ///
    /// # Errors
    /// As for [`Self::column_rates`].
    pub fn observed_rates(&mut self) -> Result<&[f64], StepError> {
        if self.at.progress.steps == 0 {
            self.column_rates()?;
            self.motors.iter().for_each(|motors| motors.tell_rates(&mut self.corrections));
            return Ok(&self.corrections);
        }
        let h = self.at.last_h;
        let [last, before] = &self.at.last;
        for (k, node) in self.nodes.iter().enumerate() {
            let rates = &mut self.corrections[node.columns.clone()];
            rates.fill(0.0);
            node.add_mean_rates(&last[k], 1.5 / h, rates);
            node.add_mean_rates(&before[k], -0.5 / h, rates);
        }
        for (motors, turned) in self.motors.iter().zip(&self.at.turned) {
            let rates = &mut self.corrections[motors.column..motors.column + 3];
            rates.copy_from_slice(&turned.observed(h));
        }
        Ok(&self.corrections)
    }

    /// Motions of columns that impulses on them cause where the system is, into `corrections`.
    pub(super) fn answer_to(&mut self, impulses: &[f64]) -> Result<(), StepError> {
        // For a step of no length impulses are momenta, and motions are velocities.
        let h = self.at.progress.h;
        self.trial.increments.fill(Increment::NONE);
        for k in 0..self.nodes.len() {
            let place = &self.places[k];
            let end = &mut self.trial.ends[k];
            end.turn = Turn::NONE;
            end.displacement = Vector3::zeros();
            end.to_center = place.to_center;
            end.inertia_turn = Vector3::zeros();
        }
        for touch in &mut self.trial.touches {
            touch.force.slope = Matrix3::zeros();
        }
        self.trial.strikes.iter_mut().for_each(Strike::forget);
        self.trial.own_slopes.fill(0.0);
        for law in &self.trial.laws {
            self.trial.own_slopes[law.column] -= law.law.rotor(0.0, h).1;
        }
        let has_loops = !self.system.closures().is_empty();
        let Self { elimination, nodes, places, trial, at, corrections, loops, .. } = self;
        elimination
            .factor(nodes, places, trial, h)
            .map_err(|joint| singular(&at.progress, joint))?;
        if has_loops {
            loops.begin(self.system.closures(), places);
            loops.stand_still();
            loops.factor(nodes, elimination);
        }
        elimination.solve(nodes, |_| Pair::ZERO, |c| impulses[c], corrections);
        if has_loops {
            loops.correct(elimination, corrections);
        }
        for x in corrections.iter_mut() {
            *x /= h;
        }
        Ok(())
    }

    /// All bodies' rates that belong to the momentum.
    ///
    /// # Errors
    /// As for [`Self::column_rates`].
    pub fn rates(&mut self) -> Result<Vec<BodyState>, StepError> {
        self.column_rates()?;
        let mut motions: Vec<Pair> = Vec::with_capacity(self.nodes.len());
        let rates = self.nodes.iter().zip(&self.places).map(|(node, place)| {
            let mut motion = match node.inboard {
                None => Pair::ZERO,
                Some(i) => {
                    let Pair { linear, angular } = motions[i];
                    Pair { linear: linear + angular.cross(&place.from_inboard), angular }
                }
            };
            node.add_rates(place, &self.corrections[node.columns.clone()], &mut motion);
            motions.push(motion);
            let v = motion.linear + motion.angular.cross(&place.to_center);
            let q = place.orientation.to_array();
            let turning = Turn { c: 0.0, v: motion.angular * 0.5 }
                .after(&Turn { c: q[0], v: Vector3::new(q[1], q[2], q[3]) });
            [v.x, v.y, v.z, turning.c, turning.v.x, turning.v.y, turning.v.z]
        });
        Ok(rates.collect())
    }

    /// Kinetic energy, and potential energy of gravity and of all springs, J.
    ///
    /// # Errors
    /// As for [`Self::column_rates`].
    pub fn energies(&mut self) -> Result<(f64, f64), StepError> {
        let along: f64 = {
            let rates = self.column_rates()?.to_vec();
            rates.iter().zip(&self.at.momenta).map(|(v, p)| v * p).sum()
        };
        let gravity = self.system.gravity();
        let weight: f64 = self
            .nodes
            .iter()
            .zip(&self.places)
            .map(|(node, place)| node.mass * gravity * place.center.z)
            .sum();
        let in_joints = self.system.energy_in_joints(|link| self.angle(link));
        let mut in_floor = 0.0;
        if let Some((floor, _)) = self.system.ground() {
            for (node, place) in self.nodes.iter().zip(&self.places) {
                let touches = &self.trial.touches[node.sites.clone()];
                for (touch, memory) in touches.iter().zip(&self.at.memories[node.sites.clone()]) {
                    let p = place.center + place.rotation * touch.arm;
                    in_floor += match &touch.plane {
                        None => memory.spring_energy(floor, &p),
                        Some(plane) => plane.spring_energy(memory, floor, &p),
                    };
                }
            }
        }
        let strikes = self.trial.strikes.iter().zip(self.system.strikers());
        let in_boxes: f64 = strikes
            .map(|(strike, striker)| strike.spring_energy(striker, &self.at.strikes, &self.places))
            .sum();
        Ok((0.5 * along, weight + in_joints + in_floor + in_boxes))
    }
}

/// `ω = 2 q̇ ⋆ q̄`, world axes.
pub(super) fn angular_velocity(rate: &BodyState, place: &Place) -> Vector3<f64> {
    let q = place.orientation.to_array();
    let turning = Turn { c: rate[3], v: Vector3::new(rate[4], rate[5], rate[6]) }
        .after(&Turn { c: q[0], v: -Vector3::new(q[1], q[2], q[3]) });
    turning.v * 2.0
}

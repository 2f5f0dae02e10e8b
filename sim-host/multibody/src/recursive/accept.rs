//! From a trial that solves a step to where the next one begins.

use super::node::Place;
use super::simulation::Simulation;
use super::step::Step;
use super::stiffness::Pair;
use super::trial::Trial;

impl Simulation {
    /// Goes on to the trial's end.
    pub(super) fn go_on(&mut self, h: f64) {
        let ratio = h / self.at.last_h;
        self.note_impulses();
        for (moved, k) in self.at.watched.iter_mut().zip(&self.watched) {
            let end = &self.trial.ends[*k];
            let angular = end.turn.rotation_vector();
            moved.go_on(Pair { linear: end.velocity * h, angular }, ratio);
        }
        let world = Place::world();
        for (k, node) in self.nodes.iter().enumerate() {
            let inboard = node.inboard.map_or(&world, |i| &self.places[i]);
            self.at.coordinates[k] =
                node.moved(&self.at.coordinates[k], &self.trial.increments[k], inboard);
        }
        self.at.guess.learn(&self.nodes, &self.trial.increments);
        self.at.last.swap(0, 1);
        self.at.last[0].copy_from_slice(&self.trial.increments);
        if h != self.at.last_h {
            for before in &mut self.at.last[1] {
                *before = before.scaled(ratio);
            }
        }
        self.at.last_h = h;
        self.find_places();
        let in_loops = self.driven.iter().map(|driven| driven.angles);
        let angles = self.motors.iter().map(|motors| motors.angles()).chain(in_loops);
        for (turned, angles) in self.at.turned.iter_mut().zip(angles) {
            turned.go_on(angles, ratio);
        }
        self.trial.end_motors(&self.motors, &self.loads, h);
        self.trial.end_rotors(&self.nodes, h);
        let coordinates = &self.at.coordinates;
        let step = Step {
            system: &self.system,
            nodes: &self.nodes,
            places: &self.places,
            angles: &|k| coordinates[k].angles[0],
            momenta: &[],
            memories: &[],
            strikes: &[],
            loads: &self.loads,
            h,
        };
        for k in 0..self.nodes.len() {
            self.trial.ends[k].all = self.trial.end_momentum(&step, k, &self.places[k]);
        }
        let Trial { strikes, ends, .. } = &mut self.trial;
        if !strikes.is_empty() {
            let speeds = ends.iter().map(|end| end.velocity.abs().max());
            self.at.fastest = speeds.fold(self.at.fastest, f64::max);
            for (strike, force) in strikes.iter().zip(&mut self.at.strike_forces) {
                strike.add_end_impulses(&self.places, ends, h);
                *force = strike.remember(&mut self.at.strikes).into();
            }
        }
        for (body, impulse) in self.driven.iter().flat_map(|driven| driven.impulses(h)) {
            ends[body].all.angular += impulse.angular;
        }
        let own = std::mem::take(&mut self.trial.own_impulses);
        self.gather_momenta(|c| own[c]);
        self.trial.own_impulses = own;
        self.note_momenta();
        for (k, touch) in self.trial.touches.iter().enumerate() {
            self.at.memories[k] = touch.force.point;
            self.at.forces[k] = touch.force.force.into();
        }
    }
}

//! A planar motion's steps.

use super::super::stepping::{LEAST_TURN, StepEquations};
use super::algebra::Turn;
use super::checkpoint::PlanarCheckpoint;
use super::node::Kind;
use super::simulation::PlanarSimulation;
use nalgebra::Vector2;
use surefoot_mechanics::integrators::Progress;

impl StepEquations for PlanarSimulation {
    fn progress(&self) -> &Progress {
        &self.at.progress
    }

    fn progress_mut(&mut self) -> &mut Progress {
        &mut self.at.progress
    }

    fn save(&mut self) {
        self.saved.copy_from(&self.at);
    }

    fn go_back(&mut self) {
        self.at.copy_from(&self.saved);
        self.find_places();
        self.tell_contacts();
    }

    /// The guess: a cubic through the last four increments, so that one iteration is mostly enough. On a floor,
    /// where they are not smooth, and after steps of another length, that they change as they did before.
    fn begin(&mut self, h: f64) {
        let ratio = h / self.at.last_h;
        let [a, b, c, d] = &self.at.last;
        if ratio == 1.0 && self.touches.is_empty() {
            let past = a.iter().zip(b).zip(c.iter().zip(d));
            for (guess, ((a, b), (c, d))) in self.increments.iter_mut().zip(past) {
                *guess = 4.0 * (a + c) - 6.0 * b - d;
            }
        } else {
            for (guess, (a, b)) in self.increments.iter_mut().zip(a.iter().zip(b)) {
                *guess = ratio * (a + ratio * (a - b));
            }
        }
        self.begin_step(h);
        self.measure_step(h);
    }

    fn evaluate(&mut self, h: f64) -> f64 {
        let residual = self.residuals(h);
        let mut scale = self.scales.step;
        if !self.touches.is_empty() {
            scale.terms += self.felt(h);
        }
        scale.relative(residual)
    }

    fn correct(&mut self, anew: bool, h: f64) -> Result<(), usize> {
        let Self { elimination, nodes, places, ends, touches, own_slopes, .. } = self;
        if anew {
            elimination.factor(nodes, places, ends, touches, own_slopes, h)?;
        }
        let (momenta, own) = (&self.at.momenta, &self.own_impulses);
        let wanted = |c: usize| momenta[c] + own[c];
        elimination.solve(nodes, places, |k| ends[k].own, wanted, &mut self.corrections);
        self.base.copy_from_slice(&self.increments);
        Ok(())
    }

    fn take(&mut self, share: f64) {
        let each = self.base.iter().zip(&self.corrections).zip(&self.turns);
        for (to, ((base, by), is_turn)) in self.increments.iter_mut().zip(each) {
            // d tan(θ/2) = ½ (1 + tan²(θ/2)) dθ
            let slope = if *is_turn { 0.5 * (1.0 + base * base) } else { 1.0 };
            *to = base + share * slope * by;
        }
    }

    fn is_folded(&self) -> bool {
        self.ends.iter().any(|end| end.turn.c < LEAST_TURN)
    }

    fn accept(&mut self, h: f64) {
        for (law, k) in self.laws.iter().zip(0..) {
            self.at.angles[k] += self.way(law.node, law.column) * law.sign;
        }
        for (node, at) in self.nodes.iter().zip(&mut self.at.coordinates) {
            let by = &self.increments[node.column..];
            match node.kind {
                Kind::Fixed => {}
                Kind::Prismatic => at.way.x += by[0],
                Kind::Revolute => {
                    let turn = Turn::of_tangent(by[0]);
                    at.turn = turn.and(&at.turn).unit();
                }
                Kind::Floating => {
                    let turn = Turn::of_tangent(by[2]);
                    at.way += Vector2::new(by[0], by[1]);
                    at.turn = turn.and(&at.turn).unit();
                }
            }
        }
        let ratio = h / self.at.last_h;
        if ratio != 1.0 {
            self.at.last.iter_mut().flatten().for_each(|before| *before *= ratio);
        }
        self.at.last.rotate_right(1);
        self.at.last[0].copy_from_slice(&self.increments);
        self.at.last_h = h;
        self.find_places();
        for k in 0..self.nodes.len() {
            self.ends[k].all = self.end_momentum(k, h);
        }
        self.end_rotors(h);
        self.gather_momenta();
        if !self.touches.is_empty() {
            let PlanarCheckpoint { memories, forces, .. } = &mut self.at;
            for ((memory, felt), touch) in memories.iter_mut().zip(forces).zip(&self.touches) {
                *memory = touch.force.point;
                let force = &touch.force.force;
                *felt = self.plane.told(&Vector2::new(force.x, force.z)).into();
            }
            self.tell_contacts();
        }
    }
}

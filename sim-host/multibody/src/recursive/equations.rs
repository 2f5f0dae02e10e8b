//! The equations of a step in joint coordinates, with loops and motors.

use super::simulation::Simulation;
use super::step::Step;
use crate::stepping::{LEAST_TURN, StepEquations, make_step};
use surefoot_mechanics::integrators::{Progress, StepError, StepFailure};
use surefoot_mechanics::newton::NewtonFailure;

impl Simulation {
    /// One step. Where its equations have no solution nearby it is made in 2, 4, … 64 shorter ones, which
    /// [`Progress::split_steps`] counts.
    ///
    /// # Errors
    /// A [`StepError`]; the motion is then where it was.
    ///
    /// # Cost
    /// Linear in the number of links for each Newton iteration; no allocation.
    pub fn step(&mut self) -> Result<(), StepError> {
        make_step(self)
    }
}

impl StepEquations for Simulation {
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
    }

    fn begin(&mut self, h: f64) {
        if h != self.at.last_h {
            self.at.guess.scale(h / self.at.last_h);
        }
        self.at.guess.make(&self.nodes, &mut self.trial.increments);
        self.trial.begin(&self.system, &self.nodes, &self.places, self.at.fastest, h);
        self.trial.begin_motors(&self.motors, &self.loads);
        if !self.system.closures().is_empty() {
            self.loops.begin(self.system.closures(), &self.places);
            self.loops.drive(self.driven.iter().flat_map(|driven| driven.impulses(h)));
        }
        self.measure_step(h);
    }

    /// (4) of [`crate::scale`], and the same of the loops' largest error.
    fn evaluate(&mut self, h: f64) -> f64 {
        let coordinates = &self.at.coordinates;
        let step = Step {
            system: &self.system,
            nodes: &self.nodes,
            places: &self.places,
            angles: &|k| coordinates[k].angles[0],
            momenta: &self.at.momenta,
            memories: &self.at.memories,
            strikes: &self.at.strikes,
            loads: &self.loads,
            h,
        };
        let has_loops = !self.system.closures().is_empty();
        self.trial.evaluate(&step, has_loops.then_some((&self.loops, &self.at.multipliers[..])));
        let mut scale = self.scales.step;
        if self.system.ground().is_some() || !self.trial.strikes.is_empty() {
            scale.terms += self.trial.felt(&step);
        }
        let mut loop_error = 0.0;
        if has_loops {
            self.loops.end(self.system.closures(), &self.places, &self.trial);
            let way = h.abs() * (scale.motion / self.scales.mass).sqrt();
            loop_error = self.loops.largest_error(way);
        }
        let mut sum = 0.0;
        for (r, weight) in self.trial.residuals.iter().zip(&self.scales.weights) {
            let relative = r * weight;
            sum += relative * relative;
        }
        scale.relative(sum) + loop_error
    }

    fn correct(&mut self, anew: bool, h: f64) -> Result<(), usize> {
        let has_loops = !self.system.closures().is_empty();
        let Self { elimination, nodes, places, trial, at, corrections, loops, .. } = self;
        let momenta = &at.momenta;
        if anew {
            elimination.factor(nodes, places, trial, h)?;
            if has_loops {
                loops.factor(nodes, elimination);
            }
        }
        let own = |c: usize| momenta[c] + trial.own_impulses[c];
        elimination.solve(nodes, |k| trial.ends[k].own, own, corrections);
        if has_loops {
            loops.correct(elimination, corrections);
        }
        self.base.copy_from_slice(&self.trial.increments);
        self.base_multipliers.copy_from_slice(&self.at.multipliers);
        Ok(())
    }

    fn take(&mut self, share: f64) {
        for (k, node) in self.nodes.iter().enumerate() {
            let by = &self.corrections[node.columns.clone()];
            self.trial.increments[k] = node.corrected(&self.base[k], by, share);
        }
        let all = self.at.multipliers.iter_mut().zip(&self.base_multipliers);
        for ((to, base), by) in all.zip(&self.loops.corrections) {
            *to = base + share * by;
        }
    }

    fn is_folded(&self) -> bool {
        self.trial.ends.iter().any(|end| end.turn.c < LEAST_TURN)
    }

    fn accept(&mut self, h: f64) {
        self.go_on(h);
    }

    fn locked(&self) -> Option<usize> {
        Simulation::locked(self)
    }

    fn may_split(&self) -> bool {
        self.splits
    }
}

pub(super) fn singular(progress: &Progress, joint: usize) -> StepError {
    progress.error(StepFailure::Newton(NewtonFailure::SingularJacobian { pivot: joint }))
}

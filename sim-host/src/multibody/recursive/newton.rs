//! One step: Newton's method with a line search, and shorter steps where it fails.

use super::simulation::Simulation;
use super::step::Step;
use crate::integrators::{Progress, StepError, StepFailure};
use crate::newton::NewtonFailure;

/// Newton steps at most.
pub(in crate::multibody) const MOST_ITERATIONS: u32 = 40;
/// Halvings of a Newton step at most.
pub(in crate::multibody) const MOST_HALVINGS: u32 = 12;
/// Residuals, relative to their terms, that count as a root once they fall no further.
pub(in crate::multibody) const TOLERANCE: f64 = 1e-10;
/// Residuals that count as a root at once.
pub(in crate::multibody) const ROUND_OFF: f64 = 2e-15;
/// While residuals fall by this in an iteration, the elimination is used again.
pub(in crate::multibody) const FAST: f64 = 1e-2;
/// Cosine of half the angle by which a body may turn in a step: beyond a quarter turn (2.51) folds.
pub(in crate::multibody) const LEAST_TURN: f64 = std::f64::consts::FRAC_1_SQRT_2;
/// Steps that may be made in shorter ones: so many, and one of so many.
pub(in crate::multibody) const FREE_SPLITS: u64 = 10;
pub(in crate::multibody) const STEPS_PER_SPLIT: u64 = 100;
/// A step that fails is made in 2, 4, … up to 2 to this power.
pub(in crate::multibody) const MOST_SPLITS: u32 = 6;

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
        self.saved.copy_from(&self.at);
        let h = self.at.progress.h;
        let mut result = self.advance(h);
        let mut splits = 0;
        while result.is_err() && self.splits && splits < MOST_SPLITS {
            // What was evaluated in vain has been evaluated.
            let evaluations = self.at.progress.evaluations;
            self.restore_saved();
            self.at.progress.evaluations = evaluations;
            splits += 1;
            let parts = 1_u32 << splits;
            let made = (0..parts).try_for_each(|_| self.advance(h / f64::from(parts)));
            if made.is_ok() {
                self.at.progress.split_steps += 1;
                result = self.bear_splits();
                break;
            }
        }
        self.conclude(result)
    }

    /// Counts the step, or goes back to where it began.
    pub(super) fn conclude(&mut self, result: Result<(), StepError>) -> Result<(), StepError> {
        match result {
            Ok(()) => self.at.progress.advance(),
            Err(_) => self.restore_saved(),
        }
        result
    }

    /// Shorter steps now and then do no harm; by the dozen they turn the method into another one, whose
    /// energy grows.
    fn bear_splits(&self) -> Result<(), StepError> {
        let progress = &self.at.progress;
        if progress.split_steps <= FREE_SPLITS + progress.steps / STEPS_PER_SPLIT {
            return Ok(());
        }
        let splits = progress.split_steps;
        Err(progress.error(StepFailure::TooManySplits { splits }))
    }

    fn restore_saved(&mut self) {
        self.at.copy_from(&self.saved);
        self.find_places();
    }

    /// Goes on by `h`.
    pub(super) fn advance(&mut self, h: f64) -> Result<(), StepError> {
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
        let mut error = self.evaluate(h);
        let mut iterations = 0;
        let mut is_fresh = false;
        'newton: loop {
            if !error.is_finite() {
                return Err(self.at.progress.error(NewtonFailure::NotFinite));
            }
            if error <= ROUND_OFF {
                break;
            }
            if iterations == MOST_ITERATIONS {
                let failure = NewtonFailure::TooManyIterations { iterations, residual: error };
                return Err(self.at.progress.error(failure));
            }
            let was_fresh = is_fresh;
            self.correct(!is_fresh, h)?;
            self.base.copy_from_slice(&self.trial.increments);
            self.base_multipliers.copy_from_slice(&self.at.multipliers);
            let mut share = 1.0;
            for halvings in 0..=MOST_HALVINGS {
                self.take(share);
                let tried = self.evaluate(h);
                if tried <= (1.0 - 1e-4 * share) * error {
                    is_fresh = tried < FAST * error;
                    error = tried;
                    iterations += 1;
                    if error <= TOLERANCE && !is_fresh {
                        // So close to a root only round-off makes it slow.
                        break 'newton;
                    }
                    continue 'newton;
                }
                if error <= TOLERANCE {
                    // Round-off has the last word: back to the best iterate.
                    self.take(0.0);
                    self.evaluate(h);
                    break 'newton;
                }
                if was_fresh {
                    // An old elimination is no reason to give up.
                    self.take(0.0);
                    self.evaluate(h);
                    is_fresh = false;
                    continue 'newton;
                }
                if halvings == MOST_HALVINGS {
                    let failure = NewtonFailure::NoRootNearby { residual: error };
                    return Err(self.at.progress.error(failure));
                }
                share *= 0.5;
            }
        }
        if self.trial.ends.iter().any(|end| end.turn.c < LEAST_TURN) {
            return Err(self.at.progress.error(StepFailure::WrongBranch));
        }
        self.accept(h);
        if let Some(joint) = self.locked() {
            return Err(self.at.progress.error(StepFailure::GimbalLock { joint }));
        }
        self.at.progress.iterated(iterations, error);
        Ok(())
    }

    /// Newton's correction at the trial, with the elimination made anew or with the last one.
    fn correct(&mut self, anew: bool, h: f64) -> Result<(), StepError> {
        let has_loops = !self.system.closures().is_empty();
        let Self { elimination, nodes, places, trial, at, corrections, loops, .. } = self;
        let momenta = &at.momenta;
        if anew {
            elimination
                .factor(nodes, places, trial, h)
                .map_err(|joint| singular(&at.progress, joint))?;
            if has_loops {
                loops.factor(nodes, elimination);
            }
        }
        let own = |c: usize| momenta[c] + trial.own_impulses[c];
        elimination.solve(nodes, |k| trial.ends[k].own, own, corrections);
        if has_loops {
            loops.correct(elimination, corrections);
        }
        Ok(())
    }

    /// A share of the corrections from the base.
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

    /// Size of the residuals at the trial, relative to their terms, and the largest error of a loop.
    fn evaluate(&mut self, h: f64) -> f64 {
        self.at.progress.evaluated(1);
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
        let mut loop_error = 0.0;
        if has_loops {
            self.loops.end(self.system.closures(), &self.places, &self.trial);
            loop_error = self.loops.largest_error();
        }
        for end in &self.trial.ends {
            let speed = end.velocity.abs().max();
            // NaN stays out, and is found in the residuals.
            self.at.fastest = self.at.fastest.max(speed.min(self.at.fastest.max(1.0) * 2.0));
        }
        let mut sum = 0.0;
        for (r, weight) in self.trial.residuals.iter().zip(&self.weights) {
            let relative = r * weight;
            sum += relative * relative;
        }
        sum.sqrt() / self.at.fastest.max(f64::MIN_POSITIVE) + loop_error
    }
}

pub(super) fn singular(progress: &Progress, joint: usize) -> StepError {
    progress.error(StepFailure::Newton(NewtonFailure::SingularJacobian { pivot: joint }))
}

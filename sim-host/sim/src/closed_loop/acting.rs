//! From a controller's torques to what motors give: late, and not more than they can.

use super::lag::{Lag, beyond};
use crate::scene::Acting;
use serde::Serialize;

/// Torques that were larger than the motors'.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct CutTorques {
    /// Joints' torques cut, one a joint and tick.
    pub joint_ticks: u64,
    /// The first tick with one, s.
    pub first_s: Option<f64>,
}

/// Motors of all joints. A torque is held from its tick to the next; the motors give the same a delay later,
/// cut to their limits, and zero before the first. Ideal ones give what they are asked for.
///
/// During a plant's step they give the mean over it, so that the impulse is exact and a delay may end
/// within a step.
#[derive(Clone, Debug)]
pub struct Motors {
    /// N·m, one a joint.
    limits: Option<Vec<f64>>,
    dead_zone: f64,
    lag: Option<Lag>,
    steps_per_tick: usize,
    /// The delay in steps: whole ones, and the part of one that is left.
    whole: usize,
    part: f64,
    /// A ring of the latest ticks' torques, as many as the delay spans.
    torques: Vec<Vec<f64>>,
    /// Their mean over the last step.
    mean: Vec<f64>,
    newest: usize,
    cut: CutTorques,
}

/// A part of a step this small is the round-off of a delay given in seconds.
const NO_PART: f64 = 1e-9;

impl Motors {
    /// As a scene has them for so many joints, for plant steps of `step_s` and so many of them a tick, at least 1.
    pub fn new(acting: &Acting, step_s: f64, steps_per_tick: usize, joints: usize) -> Self {
        let delay = acting.delay_s / step_s;
        let whole = (delay + NO_PART).floor();
        let part = if delay - whole > NO_PART { delay - whole } else { 0.0 };
        let whole = whole as usize;
        // Room for the command one step before a whole delay too, which a part of a step needs.
        let spanned = (whole + steps_per_tick) / steps_per_tick;
        Self {
            limits: acting
                .torque_limits_nm
                .map(|leg| leg.into_iter().cycle().take(joints).collect()),
            dead_zone: acting.dead_zone_nm,
            lag: (acting.lag_s > 0.0).then(|| Lag::new(acting.lag_s, step_s, joints)),
            steps_per_tick,
            whole,
            part,
            torques: vec![vec![0.0; joints]; 1 + spanned],
            mean: vec![0.0; joints],
            newest: 0,
            cut: CutTorques::default(),
        }
    }

    /// Takes a tick's torques.
    pub fn command(&mut self, torques: &[f64], time_s: f64) {
        self.newest = (self.newest + 1) % self.torques.len();
        let given = &mut self.torques[self.newest];
        let dead = self.dead_zone;
        for (given, torque) in given.iter_mut().zip(torques) {
            *given = if dead == 0.0 { *torque } else { beyond(*torque, dead) };
        }
        if let Some(limits) = &self.limits {
            for (torque, limit) in given.iter_mut().zip(limits) {
                if torque.abs() > *limit {
                    *torque = limit.copysign(*torque);
                    self.cut.joint_ticks += 1;
                    self.cut.first_s.get_or_insert(time_s);
                }
            }
        }
    }

    /// Mean torques over a plant step, the one that begins at the latest tick being 0.
    pub fn over_step(&mut self, step: usize) -> &[f64] {
        if self.part == 0.0 && self.lag.is_none() {
            return &self.torques[self.at(step, self.whole)];
        }
        self.find_command(step);
        if let Some(lag) = &self.lag {
            lag.over_step(&mut self.mean);
        }
        &self.mean
    }

    /// The mean command over a plant step.
    fn find_command(&mut self, step: usize) {
        let [late, later] = [self.whole, self.whole + 1].map(|back| self.at(step, back));
        let both = self.torques[late].iter().zip(&self.torques[later]);
        for (mean, (late, later)) in self.mean.iter_mut().zip(both) {
            *mean = (1.0 - self.part) * late + self.part * later;
        }
    }

    /// Goes on to the end of a plant step.
    pub fn advance(&mut self, step: usize) {
        if self.lag.is_none() {
            return;
        }
        self.find_command(step);
        if let Some(lag) = &mut self.lag {
            lag.advance(&self.mean);
        }
    }

    /// Where the torques are that were commanded for the step that is so many steps `back`.
    fn at(&self, step: usize, back: usize) -> usize {
        debug_assert!(step < self.steps_per_tick);
        let ticks = (back + self.steps_per_tick - 1 - step) / self.steps_per_tick;
        let length = self.torques.len();
        (self.newest + length - ticks) % length
    }

    /// What was cut so far.
    pub fn cut(&self) -> CutTorques {
        self.cut
    }

    /// Torques on their way, oldest first: all that a delay needs to go on.
    pub(super) fn pending(&self) -> Vec<Vec<f64>> {
        let (newer, older) = self.torques.split_at(self.newest + 1);
        [older, newer].concat()
    }

    /// What lagging motors give now; nothing of others.
    pub(super) fn lagging(&self) -> Option<Vec<f64>> {
        self.lag.as_ref().map(|lag| lag.given.clone())
    }

    /// Goes on with torques on their way, and what lagging motors gave; `false` if they are of other motors.
    pub(super) fn resume(&mut self, pending: &[Vec<f64>], lagging: Option<&[f64]>) -> bool {
        let joints = self.mean.len();
        match (&mut self.lag, lagging) {
            (None, None) => {}
            (Some(lag), Some(given)) if given.len() == joints => lag.given.copy_from_slice(given),
            _ => return false,
        }
        let fits = pending.len() == self.torques.len()
            && pending.iter().all(|torques| torques.len() == joints);
        if fits {
            self.torques.clone_from_slice(pending);
            self.newest = pending.len() - 1;
        }
        fits
    }
}

//! From a robot's state to what its sensors tell of it.

use super::askew::Askew;
use super::encoders::Encoders;
use super::estimate::Estimate;
use super::estimating::{EstimateTally, Estimating};
use super::filter::{FilterPlace, Filtered, SensorReadings};
use crate::plant::PlantState;
use crate::record::EncoderMemory;
use crate::robot::{MOST_LEGS, SharedRobot};
use crate::scene::{Sensing, StateSource};
use nalgebra::Vector3;
use surefoot::estimate::{Concern, EstimateFault, StartPose};

/// The sensors of a robot, read once a tick. Ideal ones read the state as it is.
#[derive(Clone, Debug)]
pub struct Sensors {
    /// What they have read last.
    seen: PlantState,
    encoders: Option<Encoders>,
    askew: Option<Askew>,
    estimate: Option<Estimate>,
    estimating: Option<Box<Estimating>>,
    /// What the estimator has failed with, once and for all.
    fault: Option<EstimateFault>,
}

impl Sensors {
    /// As a scene has them for joints with these names, for ticks `period_s` apart; of a scene whose state is
    /// estimated, the encoders alone.
    pub fn new(sensing: &Sensing, period_s: f64, joints: &[String]) -> Self {
        let [has_encoders, has_errors] = match sensing.state {
            StateSource::Truth => [false, false],
            StateSource::Noise => [true, true],
            StateSource::Estimate => [true, false],
        };
        let encoders = || Encoders::new(sensing, period_s, joints);
        Self {
            seen: PlantState::home(joints.len()),
            encoders: has_encoders.then(encoders).flatten(),
            askew: has_errors.then(|| Askew::new(sensing)).flatten(),
            estimate: (has_errors && sensing.is_noisy()).then(|| Estimate::new(sensing, period_s)),
            estimating: None,
            fault: None,
        }
    }

    /// The same of a robot, with its state estimator, in its place and for a robot that walks or not, where the scene
    /// has one.
    ///
    /// # Panics
    /// For a scene that is not checked.
    pub fn of_robot(
        sensing: &Sensing,
        period_s: f64,
        robot: &SharedRobot,
        (place, walks): (FilterPlace, bool),
    ) -> Self {
        let is_estimated = sensing.state == StateSource::Estimate;
        let estimating = || Box::new(Estimating::new(sensing, period_s, robot, (place, walks)));
        Self {
            estimating: is_estimated.then(estimating),
            ..Self::new(sensing, period_s, &robot.columns)
        }
    }

    /// What they read at the next tick, where the state is `truth`. After a fault of the estimator, what it read last.
    pub fn read(&mut self, truth: &PlantState) -> &PlantState {
        let before = self.estimating.as_ref().map(|_| self.seen.clone());
        self.seen.clone_from(truth);
        if let Some(encoders) = &mut self.encoders {
            encoders.read(truth, &mut self.seen);
        }
        if let Some(estimate) = &mut self.estimate {
            estimate.advance();
            estimate.apply(truth, &mut self.seen);
        }
        if let Some(askew) = &self.askew {
            askew.apply(&mut self.seen);
        }
        if let (Some(estimating), Some(before)) = (&mut self.estimating, before)
            && let Err(fault) = estimating.read(truth, &mut self.seen)
        {
            self.fault.get_or_insert(fault);
            self.seen = before;
        }
        &self.seen
    }

    /// What they have read at the last tick, and where the robot was at the first, for an estimator on a target.
    pub fn readings(&self) -> Option<&(SensorReadings, StartPose<f64>)> {
        self.estimating.as_ref()?.readings()
    }

    /// What an estimator on a target has made of that.
    pub fn note(&mut self, filtered: &Filtered) {
        if let Some(estimating) = &mut self.estimating {
            estimating.note(filtered, &mut self.seen);
        }
    }

    /// Whether a state estimator makes of the readings what controllers see.
    pub fn is_estimating(&self) -> bool {
        self.estimating.is_some()
    }

    /// Tells switches of the ground's vertical forces on the feet (N), and the estimator which feet a planner has
    /// stand (all of them unless said), before a tick. Of no use to others.
    ///
    /// # Returns
    /// What the feet's switches say, as forces: the robot's weight of a foot that presses.
    pub fn see_feet(
        &mut self,
        forces: impl Iterator<Item = f64>,
        planned: Option<[bool; MOST_LEGS]>,
    ) -> Vec<f64> {
        match &mut self.estimating {
            Some(estimating) => estimating.see_feet(forces, planned),
            None => Vec::new(),
        }
    }

    /// Tells the estimator before a tick what force the ground is found to have on all feet together, central body's
    /// axes, N: of a robot that rests on its feet and on nothing else. Of no use to others.
    pub fn see_feet_force(&mut self, force: Vector3<f64>) {
        if let Some(estimating) = &mut self.estimating {
            estimating.see_feet_force(force);
        }
    }

    /// What they have read last.
    pub fn seen(&self) -> &PlantState {
        &self.seen
    }

    /// What the estimator has failed with.
    pub fn fault(&self) -> Option<EstimateFault> {
        self.fault
    }

    /// What the estimator is not to be believed any more for.
    pub fn distrusted(&self) -> Option<Concern> {
        self.estimating.as_ref()?.distrusted()
    }

    /// What the estimator has said so far, if there is one.
    pub fn tally(&self) -> Option<&EstimateTally> {
        self.estimating.as_ref().map(|estimating| estimating.tally())
    }

    /// How many joints they read.
    pub(super) fn joints(&self) -> usize {
        self.seen.joints()
    }

    /// Whether some joint's angle is not read as it is.
    pub(super) fn has_encoders(&self) -> bool {
        self.encoders.is_some()
    }

    /// What the encoders have read at the last tick; `None` for ideal ones, and before the first.
    pub(super) fn memory(&self) -> Option<EncoderMemory> {
        self.encoders.as_ref().and_then(Encoders::memory)
    }

    /// As if they had been read at `ticks` ticks, and the encoders had read this at the last.
    pub(super) fn skip(&mut self, ticks: u64, encoders: Option<&EncoderMemory>) {
        if let Some(own) = &mut self.encoders {
            own.resume(encoders);
        }
        if let Some(estimate) = &mut self.estimate {
            // No more than the noise itself: it does not know the state.
            for _ in 0..ticks {
                estimate.advance();
            }
        }
    }
}

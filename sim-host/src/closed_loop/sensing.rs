//! From a robot's state to what its sensors tell of it.

use super::askew::Askew;
use super::encoders::Encoders;
use super::estimate::Estimate;
use crate::plant::PlantState;
use crate::record::EncoderMemory;
use crate::scene::Sensing;

/// The sensors of a robot, read once a tick. Ideal ones read the state as it is.
#[derive(Clone, Debug)]
pub struct Sensors {
    /// What they have read last.
    seen: PlantState,
    encoders: Option<Encoders>,
    askew: Option<Askew>,
    estimate: Option<Estimate>,
}

impl Sensors {
    /// As a scene has them for joints with these names, for ticks `period_s` apart.
    pub fn new(sensing: &Sensing, period_s: f64, joints: &[String]) -> Self {
        Self {
            seen: PlantState::home(joints.len()),
            encoders: Encoders::new(sensing, period_s, joints),
            askew: Askew::new(sensing),
            estimate: sensing.is_noisy().then(|| Estimate::new(sensing, period_s)),
        }
    }

    /// What they read at the next tick, where the state is `truth`.
    pub fn read(&mut self, truth: &PlantState) -> &PlantState {
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
        &self.seen
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

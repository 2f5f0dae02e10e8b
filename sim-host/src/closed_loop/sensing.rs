//! From a robot's state to what its sensors tell of it.

use super::estimate::Estimate;
use crate::plant::PlantState;
use crate::scene::Sensing;
use std::f64::consts::TAU;

/// The sensors of a robot, read once a tick. Ideal ones read the state as it is.
#[derive(Clone, Debug)]
pub struct Sensors {
    /// What they have read last.
    seen: PlantState,
    encoders: Option<Encoders>,
    estimate: Option<Estimate>,
}

impl Sensors {
    /// As a scene has them for so many joints, for ticks `period_s` apart.
    pub fn new(sensing: &Sensing, period_s: f64, joints: usize) -> Self {
        Self {
            seen: PlantState::home(joints),
            encoders: (sensing.encoder_counts > 0).then(|| Encoders {
                count: TAU / f64::from(sensing.encoder_counts),
                period_s,
                is_read: false,
                last: vec![0.0; joints],
            }),
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
        &self.seen
    }

    /// How many joints they read.
    pub(super) fn joints(&self) -> usize {
        self.seen.joints()
    }

    /// The encoders' counts at the last tick; `None` for ideal ones, and before the first.
    pub(super) fn counts(&self) -> Option<Vec<f64>> {
        let encoders = self.encoders.as_ref().filter(|encoders| encoders.is_read)?;
        Some(encoders.last.clone())
    }

    /// As if they had been read at `ticks` ticks, the encoders' counts being `counts` at the last.
    pub(super) fn skip(&mut self, ticks: u64, counts: Option<&[f64]>) {
        if let Some(encoders) = &mut self.encoders {
            encoders.is_read = counts.is_some();
            for (last, count) in encoders.last.iter_mut().zip(counts.unwrap_or_default()) {
                *last = *count;
            }
        }
        if let Some(estimate) = &mut self.estimate {
            // No more than the noise itself: it does not know the state.
            for _ in 0..ticks {
                estimate.advance();
            }
        }
    }
}

/// Encoders of all joints: an angle is read to the nearest count, and a rate is the difference of two
/// readings over the tick between them. So a rate is that of half a tick before, to one count a tick.
#[derive(Clone, Debug)]
struct Encoders {
    /// rad
    count: f64,
    period_s: f64,
    /// Whether there was a tick.
    is_read: bool,
    /// Whole counts at the last one, one a joint.
    last: Vec<f64>,
}

impl Encoders {
    fn read(&mut self, truth: &PlantState, seen: &mut PlantState) {
        let (angles, rates) = (&truth.positions[7..], &truth.velocities[6..]);
        for (i, last) in self.last.iter_mut().enumerate() {
            let count = (angles[i] / self.count).round();
            // Before the first tick the robot is taken to have moved as at it.
            let before = match self.is_read {
                true => *last,
                false => ((angles[i] - rates[i] * self.period_s) / self.count).round(),
            };
            seen.positions[7 + i] = count * self.count;
            seen.velocities[6 + i] = (count - before) * self.count / self.period_s;
            *last = count;
        }
        self.is_read = true;
    }
}

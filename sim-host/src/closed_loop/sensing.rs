//! From a robot's state to what its sensors tell of it.

use super::estimate::Estimate;
use crate::plant::PlantState;
use crate::scene::Sensing;
use std::f64::consts::TAU;

/// The sensors of a robot, read once a tick. Ideal ones read the state as it is.
#[derive(Clone, Debug)]
pub struct Sensors {
    encoders: Option<Encoders>,
    estimate: Option<Estimate>,
}

impl Sensors {
    /// As a scene has them, for ticks `period_s` apart.
    pub fn new(sensing: &Sensing, period_s: f64) -> Self {
        Self {
            encoders: (sensing.encoder_counts > 0).then(|| Encoders {
                count: TAU / f64::from(sensing.encoder_counts),
                period_s,
                last: None,
            }),
            estimate: sensing.is_noisy().then(|| Estimate::new(sensing, period_s)),
        }
    }

    /// What they read at the next tick, where the state is `truth`.
    pub fn read(&mut self, truth: &PlantState) -> PlantState {
        let mut seen = *truth;
        if let Some(encoders) = &mut self.encoders {
            encoders.read(truth, &mut seen);
        }
        if let Some(estimate) = &mut self.estimate {
            estimate.advance();
            estimate.apply(truth, &mut seen);
        }
        seen
    }

    /// The encoders' counts at the last tick; `None` for ideal ones, and before the first.
    pub(super) fn counts(&self) -> Option<[f64; 12]> {
        self.encoders.as_ref().and_then(|encoders| encoders.last)
    }

    /// As if they had been read at `ticks` ticks, the encoders' counts being `counts` at the last.
    pub(super) fn skip(&mut self, ticks: u64, counts: Option<[f64; 12]>) {
        if let Some(encoders) = &mut self.encoders {
            encoders.last = counts;
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
    /// Whole counts at the last tick, left leg then right.
    last: Option<[f64; 12]>,
}

impl Encoders {
    fn read(&mut self, truth: &PlantState, seen: &mut PlantState) {
        let (angles, rates) = (&truth.positions[7..], &truth.velocities[6..]);
        let counts: [f64; 12] = std::array::from_fn(|i| (angles[i] / self.count).round());
        // Before the first tick the robot is taken to have moved as at it.
        let before = self.last.unwrap_or_else(|| {
            std::array::from_fn(|i| ((angles[i] - rates[i] * self.period_s) / self.count).round())
        });
        for i in 0..12 {
            seen.positions[7 + i] = counts[i] * self.count;
            seen.velocities[6 + i] = (counts[i] - before[i]) * self.count / self.period_s;
        }
        self.last = Some(counts);
    }
}

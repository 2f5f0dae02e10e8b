//! What joints' encoders read of their angles.

use crate::plant::PlantState;
use crate::record::EncoderMemory;
use crate::scene::Sensing;
use std::f64::consts::TAU;

/// Encoders of all joints. With counts an angle is read to the nearest one, and a rate is the difference of two
/// readings over the tick between them: so a rate is that of half a tick before, to one count a tick. With play an
/// encoder follows its joint only where that has taken up the play.
#[derive(Clone, Debug)]
pub(super) struct Encoders {
    /// rad; none of encoders that read exactly.
    count: Option<f64>,
    /// What each reads too much, rad.
    bias: Vec<f64>,
    /// Half the play, rad.
    play: f64,
    period_s: f64,
    /// Whether there was a tick.
    is_read: bool,
    last: EncoderMemory,
}

impl Encoders {
    /// Of joints with these names; `None` where all of them read exactly.
    pub fn new(sensing: &Sensing, period_s: f64, joints: &[String]) -> Option<Self> {
        let is_ideal = sensing.encoder_counts == 0
            && sensing.encoder_bias_deg.is_empty()
            && sensing.backlash_deg == 0.0;
        let bias = |name: &String| {
            sensing.encoder_bias_deg.get(name).copied().unwrap_or_default().to_radians()
        };
        let nothing = vec![0.0; joints.len()];
        (!is_ideal).then(|| Self {
            count: (sensing.encoder_counts > 0).then(|| TAU / f64::from(sensing.encoder_counts)),
            bias: joints.iter().map(bias).collect(),
            play: 0.5 * sensing.backlash_deg.to_radians(),
            period_s,
            is_read: false,
            last: EncoderMemory { angles: nothing.clone(), read: nothing },
        })
    }

    /// At the last tick; `None` before the first.
    pub fn memory(&self) -> Option<EncoderMemory> {
        self.is_read.then(|| self.last.clone())
    }

    /// Goes on from there.
    pub fn resume(&mut self, memory: Option<&EncoderMemory>) {
        self.is_read = memory.is_some();
        if let Some(memory) = memory {
            self.last.clone_from(memory);
        }
    }

    /// At the next tick.
    pub fn read(&mut self, truth: &PlantState, seen: &mut PlantState) {
        let (angles, rates) = (&truth.positions[7..], &truth.velocities[6..]);
        for (i, bias) in self.bias.iter().enumerate() {
            let before = self.last.angles[i];
            let (mut angle, mut rate) = (angles[i], rates[i]);
            if self.play > 0.0 && self.is_read {
                angle = before.clamp(angle - self.play, angle + self.play);
                rate = if angle == before { 0.0 } else { rate };
            }
            self.last.angles[i] = angle;
            let angle = angle + bias;
            let (read, seen_rate) = match self.count {
                None => (angle, rate),
                Some(count) => {
                    let counts = (angle / count).round();
                    // Before the first tick the robot is taken to have moved as at it.
                    let before = match self.is_read {
                        true => self.last.read[i],
                        false => ((angle - rate * self.period_s) / count).round(),
                    };
                    (counts, (counts - before) * count / self.period_s)
                }
            };
            self.last.read[i] = read;
            seen.positions[7 + i] = read * self.count.unwrap_or(1.0);
            seen.velocities[6 + i] = seen_rate;
        }
        self.is_read = true;
    }
}

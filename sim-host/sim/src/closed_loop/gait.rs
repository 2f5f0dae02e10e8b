//! How a robot has walked.

use super::{Outcome, Run};
use crate::record::Sample;
use crate::robot::Robot;
use nalgebra::Vector2;
use serde::Serialize;

/// What a walking controller counts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GaitTally {
    /// Touch-downs of a foot, or a pair of feet.
    pub steps: u32,
    /// When the robot first had a command to walk, and when then one to stand, s.
    pub told_s: [Option<f64>; 2],
}

/// A walk in numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Gait {
    /// Mean speed over the second half of the time for which it was told to walk, from where the central body was to
    /// where it came, m/s.
    pub speed_m_s: f64,
    /// Touch-downs of a foot, or a pair of feet.
    pub steps: u32,
    /// 1 for a run that fell or was stopped.
    pub falls: u32,
    /// Work of the motors, either sign counted as spent, over weight and distance, since the robot was first to
    /// walk; none where it covered less than its own height.
    pub cost_of_transport: Option<f64>,
    /// From the first sample to the last, m.
    pub distance_m: f64,
    /// Largest tilt of the central body, degrees.
    pub tilt_deg: f64,
    /// When it was told to stand, or the run ended, s.
    pub ended_s: f64,
}

impl Gait {
    /// Of a run that has ended.
    pub(super) fn of(tally: &GaitTally, run: &Run, robot: &Robot) -> Self {
        let samples = &run.samples;
        let at = |sample: &Sample| Vector2::new(sample.positions[0], sample.positions[1]);
        let way = |samples: &[Sample]| match samples {
            [first, .., last] => ((at(last) - at(first)).norm(), last.time_s - first.time_s),
            _ => (0.0, 0.0),
        };
        let until = |time: Option<f64>| {
            samples.partition_point(|sample| sample.time_s < time.unwrap_or(f64::INFINITY))
        };
        let [begun, ended] = tally.told_s.map(until);
        let (late, time) = way(&samples[usize::midpoint(begun, ended)..ended]);
        let walked = &samples[begun..];
        let (distance, _) = way(walked);
        let power = |sample: &Sample| -> f64 {
            let rates = sample.velocities[6..].iter();
            sample.torques.iter().zip(rates).map(|(torque, rate)| (torque * rate).abs()).sum()
        };
        let work: f64 =
            walked.windows(2).map(|pair| power(&pair[0]) * (pair[1].time_s - pair[0].time_s)).sum();
        let weight = robot.tree.mass() * robot.tree.gravity().norm();
        let height = samples.first().map_or(f64::INFINITY, |sample| sample.positions[2]);
        let tilt = |sample: &Sample| {
            let [x, y] = [sample.positions[4], sample.positions[5]];
            (1.0 - 2.0 * (x * x + y * y)).clamp(-1.0, 1.0).acos().to_degrees()
        };
        Self {
            speed_m_s: if time > 0.0 { late / time } else { 0.0 },
            steps: tally.steps,
            falls: u32::from(matches!(run.outcome, Outcome::Fell | Outcome::Stopped)),
            cost_of_transport: (distance > height).then(|| work / (weight * distance)),
            distance_m: way(samples).0,
            ended_s: ended.checked_sub(1).map_or(0.0, |last| samples[last].time_s),
            tilt_deg: samples.iter().map(tilt).fold(0.0, f64::max),
        }
    }
}

//! A problem played, and its error.

use super::boxes::over_engines;
use super::problems::Measure;
use super::references::{At, Bicycle, Pose};
use nalgebra::Vector3;
use serde::Deserialize;
use std::time::{Duration, Instant};
use surefoot::spatial::Quaternion;
use surefoot_sim::mechanism::start;
use surefoot_sim::scene::{Mechanism, MechanismScene};

/// Where everything was.
#[derive(Clone, Debug, Deserialize)]
pub struct Trace {
    /// s
    pub time_s: f64,
    /// Positions and quaternions of all bodies.
    pub configuration: Vec<f64>,
    /// Their rates.
    pub velocity: Vec<f64>,
    /// J
    pub energy: f64,
}

/// What came out.
#[derive(Clone, Debug)]
pub struct Played {
    /// By the problem's measure; none if it did not reach the end.
    pub error: Option<f64>,
    /// Why not.
    pub failure: Option<String>,
    /// The step that was made, s.
    pub step_s: f64,
    /// Computing time of the steps.
    pub wall: Duration,
    /// Some four hundred instants, and those of the reference.
    pub traces: Vec<Trace>,
    /// Names of the bodies.
    pub bodies: Vec<String>,
}

/// Instants that are kept of a run: as many as IFToMM's results have.
const KEPT: u64 = 400;

/// Plays a scene to the last time of the reference, in steps of which a whole number leads to each of its times.
pub(super) fn play(scene: &MechanismScene, measure: Measure, times: &[At]) -> Played {
    let mut scene = scene.clone();
    let Some((step_s, steps)) = kept(scene.integrator.step_s, times) else {
        return Played::failed(0.0, "no reference".to_owned());
    };
    let last = steps.last().copied().unwrap_or_default();
    scene.integrator.step_s = step_s;
    scene.duration_s = last as f64 * step_s;
    let mut played = Played::failed(step_s, String::new());
    played.failure = None;
    if let Mechanism::Multibody(all) = &scene.mechanism {
        played.bodies = all.bodies.iter().map(|body| body.name.clone()).collect();
    }
    let mut moving = match start(&scene) {
        Ok(moving) => moving,
        Err(error) => return Played { failure: Some(error.to_string()), ..played },
    };
    for step in 0..=last {
        if steps.binary_search(&step).is_ok() {
            let looked = moving.state().and_then(|(configuration, velocity)| {
                let energy = moving.conserved()?.0;
                let time_s = step as f64 * step_s;
                Ok(Trace { time_s, configuration, velocity, energy })
            });
            match looked {
                Ok(trace) => played.traces.push(trace),
                Err(error) => return Played { failure: Some(error.to_string()), ..played },
            }
        }
        if step < last {
            let begun = Instant::now();
            let made = moving.step();
            played.wall += begun.elapsed();
            if let Err(error) = made {
                return Played { failure: Some(error.to_string()), ..played };
            }
        }
    }
    played.error = error(&scene, measure, times, &played);
    played
}

/// A step of which a whole number leads to each of these times, at most as long as the one that is wanted, and the
/// steps at which a run is looked at; none without a time.
pub(super) fn kept(wanted_s: f64, times: &[At]) -> Option<(f64, Vec<u64>)> {
    let (first, last) = (times.first()?, times.last()?);
    let step_s = first.t / (first.t / wanted_s - 1e-9).ceil().max(1.0);
    let at = |t: f64| (t / step_s).round() as u64;
    let every = at(last.t).div_ceil(KEPT).max(1);
    let mut steps: Vec<u64> = (0..=at(last.t)).step_by(every as usize).collect();
    steps.extend(times.iter().map(|time| at(time.t)));
    steps.sort_unstable();
    steps.dedup();
    Some((step_s, steps))
}

impl Played {
    fn failed(step_s: f64, why: String) -> Self {
        let (wall, traces, bodies) = (Duration::ZERO, Vec::new(), Vec::new());
        Self { error: None, failure: Some(why), step_s, wall, traces, bodies }
    }

    fn at(&self, t: f64) -> Option<&Trace> {
        self.traces.iter().find(|trace| (trace.time_s - t).abs() < 0.5 * self.step_s)
    }
}

pub(super) fn error(
    scene: &MechanismScene,
    measure: Measure,
    times: &[At],
    played: &Played,
) -> Option<f64> {
    if measure == Measure::OverEngines {
        return over_engines(scene, &played.traces);
    }
    let mut largest = 0.0_f64;
    for time in times {
        let trace = played.at(time.t)?;
        if let Some(wanted) = &time.bicycle {
            largest = largest.max(off_bicycle(wanted, played.traces.first()?, trace)?);
        }
        for (name, pose) in &time.bodies {
            let k = played.bodies.iter().position(|body| body == name)?;
            let (position, angle) = off(pose, trace.configuration.get(7 * k..7 * k + 7)?);
            largest = largest.max(match measure {
                Measure::Position => position,
                Measure::Attitude => angle,
                _ => position.max(angle),
            });
        }
    }
    Some(largest)
}

/// Distance, m, and angle, rad.
fn off(wanted: &Pose, state: &[f64]) -> (f64, f64) {
    let distance = |a: &[f64], b: &[f64], sign: f64| -> f64 {
        a.iter().zip(b).map(|(a, b)| (a - sign * b).powi(2)).sum::<f64>().sqrt()
    };
    let angle = wanted.quaternion.map_or(0.0, |q| {
        // Both signs are the same attitude; a small distance is half the angle.
        2.0 * distance(&state[3..], &q, 1.0).min(distance(&state[3..], &q, -1.0))
    });
    (distance(&state[..3], &wanted.position, 1.0), angle)
}

/// The bicycle's frame comes first, then its rear wheel and its handlebar.
fn off_bicycle(wanted: &Bicycle, start: &Trace, now: &Trace) -> Option<f64> {
    let turn = |of: &Trace, k: usize| {
        let q = of.configuration.get(7 * k + 3..7 * k + 7)?;
        Some(Quaternion::from_array([q[0], q[1], q[2], q[3]]))
    };
    let (frame, bar) = (turn(now, 0)?, turn(now, 2)?);
    // Across the frame, level where it stands upright; heading lies across that and level.
    let y = frame.rotate(Vector3::y());
    let level = y.x.hypot(y.y);
    let rates = now.velocity.get(3..7)?;
    let rate = Quaternion::from_array([rates[0], rates[1], rates[2], rates[3]]);
    let omega = frame.rotate(frame.conjugate().product(rate).v * 2.0);
    let of_start = turn(start, 0)?.conjugate().product(turn(start, 2)?);
    let steered = of_start.conjugate().product(frame.conjugate().product(bar));
    let steer = 2.0 * steered.v.norm().atan2(steered.s.abs());
    let hub = now.velocity.get(7..9)?;
    let errors = [
        y.z.asin() - wanted.roll,
        steer - wanted.steer.abs(),
        (omega.x * y.y - omega.y * y.x) / level - wanted.roll_rate,
        (hub[0] * y.y - hub[1] * y.x) / level - wanted.forward_speed,
    ];
    Some(errors.iter().fold(0.0, |m, e| m.max(e.abs())))
}

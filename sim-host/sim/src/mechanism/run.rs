//! One run.

use super::cause::{Cause, Kept, cause};
use super::model::{ChosenModel, MechanismModel, Started};
use super::moving::Moving;
use super::start::{StartFailure, start_model};
use crate::follow::Follow;
use crate::record::{Event, EventKind, MotionIdentity, SavedRun};
use crate::scene::MechanismScene;
use std::time::{Duration, Instant};
use surefoot_mechanics::integrators::{Progress, StepError};
use surefoot_multibody::contact::{ContactPoint, ContactState};

/// One sample.
#[derive(Clone, Debug, PartialEq)]
pub struct MechanismSample {
    /// s
    pub time_s: f64,
    /// `x`
    pub configuration: Vec<f64>,
    /// `ẋ`
    pub velocity: Vec<f64>,
    /// Kinetic energy, J.
    pub kinetic: f64,
    /// Kinetic and potential energy, J.
    pub energy: f64,
    /// As far as it is conserved, N·m·s.
    pub momentum: Vec<f64>,
    /// Largest constraint.
    pub constraint: f64,
    /// States of the points that can touch the floor.
    pub contacts: Vec<ContactState>,
    /// Mean forces of the floor on them in the last step, N, world frame.
    pub contact_forces: Vec<[f64; 3]>,
    /// Where it was one step earlier.
    pub earlier: Earlier,
}

/// Where a motion was one step before a sample.
#[derive(Clone, Debug, PartialEq)]
pub enum Earlier {
    /// There was no step, or it was made in shorter ones.
    Unknown,
    /// Where the sample before has it.
    SampleBefore,
    /// At another time.
    State {
        /// s
        time_s: f64,
        /// `x`
        configuration: Vec<f64>,
        /// `ẋ`
        velocity: Vec<f64>,
    },
}

/// What a run leaves.
#[derive(Clone, Debug)]
pub struct MechanismRun {
    /// At most some thousand, evenly spaced, the first and last included.
    pub samples: Vec<MechanismSample>,
    /// Least and greatest energy at all steps, J.
    pub energy_range: [f64; 2],
    /// Largest constraint at all steps.
    pub constraint_max: f64,
    /// Time, steps, iterations.
    pub progress: Progress,
    /// Coordinates and constraints.
    pub unknowns: usize,
    /// The model that it was played with, if there are several.
    pub model: Option<ChosenModel>,
    /// The longest step foretold, s.
    pub forecast_s: Option<f64>,
    /// Touch-downs and lift-offs of contact points.
    pub events: Vec<Event>,
    /// Where it stopped, if it can be taken up again.
    pub saved: Option<SavedRun>,
    /// Whether it was ended before its time, by whoever followed it.
    pub is_interrupted: bool,
    /// Why it failed.
    pub failure: Option<StepError>,
    /// What trials have found about that.
    pub cause: Option<Cause>,
    /// Largest kinetic energy of the samples, J.
    pub kinetic_max: f64,
    /// Whether nothing takes or gives energy.
    pub keeps_energy: bool,
    /// Computing time.
    pub wall: Duration,
}

/// Moments at which the longest step is foretold.
const FORECASTS: u64 = 10;
/// Motions that are kept for trials in a run that fails, one after the other.
const KEPT: u64 = 100;
/// Share of the largest kinetic energy by which a kept energy may be off before the run says so.
const LOST: f64 = 0.1;
/// The same share of the energy itself, of what hardly moves.
pub(super) const ROUND_OFF: f64 = 1e-9;
/// Samples at most.
const SAMPLES: u64 = 4000;
/// Numbers in the states of all samples at most, 8 bytes each; joints and what they bear take twice that again.
const MOST_NUMBERS: u64 = 20_000_000;

/// Runs a scene; `follow` hears of the time that is reached, and may end the run there.
///
/// # Errors
/// A [`StartFailure`].
pub fn run(scene: &MechanismScene, follow: &mut dyn Follow) -> Result<MechanismRun, StartFailure> {
    run_from(scene, None, follow)
}

/// The same from where a run has stopped, if one is given: to the same bits as if it had gone on.
///
/// # Errors
/// A [`StartFailure`], also for a checkpoint of another motion.
pub fn run_from(
    scene: &MechanismScene,
    from: Option<&SavedRun>,
    follow: &mut dyn Follow,
) -> Result<MechanismRun, StartFailure> {
    run_model(scene, None, from, follow)
}

/// The same with a model that is wanted, in place of the smallest.
///
/// # Errors
/// A [`StartFailure`], also where the scene does not bear the model.
pub fn run_model(
    scene: &MechanismScene,
    wanted: Option<MechanismModel>,
    from: Option<&SavedRun>,
    follow: &mut dyn Follow,
) -> Result<MechanismRun, StartFailure> {
    let Started { mut moving, model } = start_model(scene, wanted)?;
    let motion = MotionIdentity::of_mechanism(scene, model.as_ref());
    if let Some(saved) = from {
        if let Some(difference) = saved.motion.difference(&motion) {
            return Err(StartFailure::OtherMotion { difference });
        }
        moving.restore(&saved.checkpoint)?;
    }
    let first = moving.progress().steps;
    let mut watch = Watch { down: is_down(moving.contacts()).collect() };
    let steps = (scene.duration_s / scene.integrator.step_s).round().max(1.0) as u64;
    // A motion that cannot say where it is fails at its first sample.
    let numbers = moving.state().map_or(1, |(x, v)| (x.len() + v.len()) as u64);
    let every = steps.div_ceil(SAMPLES.min(MOST_NUMBERS / numbers).max(1));
    let mut run = MechanismRun {
        samples: Vec::new(),
        energy_range: [f64::INFINITY, f64::NEG_INFINITY],
        constraint_max: 0.0,
        progress: *moving.progress(),
        unknowns: moving.unknowns(),
        model,
        forecast_s: None,
        events: Vec::new(),
        saved: None,
        is_interrupted: false,
        failure: None,
        cause: None,
        kinetic_max: 0.0,
        keeps_energy: moving.keeps_energy(),
        wall: Duration::ZERO,
    };
    let mut kept: [Option<Kept>; 2] = [None, None];
    let mut earlier = Earlier::Unknown;
    let begun = Instant::now();
    for step in first..=steps.max(first) {
        let is_sample = step % every == 0 || step == steps;
        if step % steps.div_ceil(FORECASTS) == 0 {
            let now = moving.forecast_s();
            run.forecast_s = match (run.forecast_s, now) {
                (Some(a), Some(b)) => Some(a.min(b)),
                (a, b) => a.or(b),
            };
        }
        let was = std::mem::replace(&mut earlier, Earlier::Unknown);
        if let Err(error) = look(moving.as_mut(), &mut run, is_sample.then_some(was)) {
            run.failure = Some(error);
            break;
        }
        if step % steps.div_ceil(KEPT) == 0 {
            let h = run.progress.h;
            let moving = moving.in_steps_of(h);
            let now = moving.map(|moving| Kept { time_s: run.progress.time_s, moving });
            kept = [kept[1].take(), now];
        }
        if step >= steps {
            break;
        }
        if is_sample && follow.reached(run.progress.time_s).is_break() {
            run.is_interrupted = true;
            break;
        }
        let next_is_sample = (step + 1) % every == 0 || step + 1 == steps;
        if next_is_sample {
            earlier = now(moving.as_mut(), is_sample);
        }
        let split = moving.progress().split_steps;
        if let Err(error) = moving.step() {
            run.failure = Some(error);
            break;
        }
        if moving.progress().split_steps != split {
            earlier = Earlier::Unknown;
        }
        watch.look(moving.as_ref(), &mut run.events);
    }
    run.progress = *moving.progress();
    run.saved = moving.checkpoint().map(|checkpoint| SavedRun {
        scene: scene.name.clone(),
        motion,
        scalar: None,
        time_s: run.progress.time_s,
        torques_on: false,
        checkpoint,
        hardware: None,
        supervisor: None,
        limit_rows: Vec::new(),
        observer: Vec::new(),
    });
    run.wall = begun.elapsed();
    // The one before last: what fails has begun before it fails.
    let kept = kept.into_iter().flatten().next();
    run.cause = run
        .failure
        .as_ref()
        .map(|failure| cause(scene, wanted, (failure, run.unknowns), kept.as_ref()));
    Ok(run)
}

/// Watches contact points.
struct Watch {
    down: Vec<bool>,
}

fn is_down(contacts: &[ContactPoint]) -> impl Iterator<Item = bool> + '_ {
    contacts.iter().map(|point| point.state != ContactState::Free)
}

impl Watch {
    /// Appends what changed since the last look.
    fn look(&mut self, moving: &dyn Moving, events: &mut Vec<Event>) {
        let time_s = moving.progress().time_s;
        for (k, (was, is)) in self.down.iter_mut().zip(is_down(moving.contacts())).enumerate() {
            if *was != is {
                let kind = if is { EventKind::TouchDown } else { EventKind::LiftOff };
                events.push(Event { time_s, kind, place: format!("point {}", k + 1) });
                *was = is;
            }
        }
    }
}

/// Where a motion is, before the step to a sample.
fn now(moving: &mut dyn Moving, is_sample: bool) -> Earlier {
    if is_sample {
        return Earlier::SampleBefore;
    }
    let time_s = moving.progress().time_s;
    match moving.state() {
        Ok((configuration, velocity)) => Earlier::State { time_s, configuration, velocity },
        Err(_) => Earlier::Unknown,
    }
}

/// Looks at a motion; a sample is taken if one is given where it was a step earlier.
fn look(
    moving: &mut dyn Moving,
    run: &mut MechanismRun,
    sample: Option<Earlier>,
) -> Result<(), StepError> {
    run.progress = *moving.progress();
    let (energy, momentum, constraint) = moving.conserved()?;
    run.energy_range = [run.energy_range[0].min(energy), run.energy_range[1].max(energy)];
    run.constraint_max = run.constraint_max.max(constraint);
    if let Some(earlier) = sample {
        let (configuration, velocity) = moving.state()?;
        let kinetic = moving.kinetic(&configuration, &velocity);
        run.kinetic_max = run.kinetic_max.max(kinetic);
        run.samples.push(MechanismSample {
            time_s: run.progress.time_s,
            configuration,
            velocity,
            kinetic,
            energy,
            momentum,
            constraint,
            contacts: moving.contacts().iter().map(|point| point.state).collect(),
            contact_forces: moving.contact_forces(),
            earlier,
        });
    }
    Ok(())
}

impl MechanismRun {
    /// Whether energy that nothing takes or gives has changed beyond bearing.
    pub fn has_lost_energy(&self) -> bool {
        let [low, high] = self.energy_range;
        // What hardly moves has round-off of potential energy to show.
        let round_off = ROUND_OFF * low.abs().max(high.abs());
        self.keeps_energy && high - low > LOST * self.kinetic_max + round_off
    }

    /// Slope of the energy's straight line, J/s; none for fewer than two samples.
    pub fn energy_slope(&self) -> Option<f64> {
        let n = self.samples.len() as f64;
        let first = self.samples.first()?.energy;
        let mean_t = self.samples.iter().map(|s| s.time_s).sum::<f64>() / n;
        let mean_e = self.samples.iter().map(|s| s.energy - first).sum::<f64>() / n;
        let along = |s: &MechanismSample| (s.time_s - mean_t) * (s.energy - first - mean_e);
        let variance: f64 = self.samples.iter().map(|s| (s.time_s - mean_t).powi(2)).sum();
        (variance > 0.0).then(|| self.samples.iter().map(along).sum::<f64>() / variance)
    }

    /// Largest change of the conserved angular momentum, relative to its size; none where that is zero.
    pub fn momentum_drift(&self) -> Option<f64> {
        let first = &self.samples.first()?.momentum;
        let size = first.iter().map(|m| m * m).sum::<f64>().sqrt();
        let change = |s: &MechanismSample| {
            s.momentum.iter().zip(first).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
        };
        (size > 1e-12).then(|| self.samples.iter().map(change).fold(0.0, f64::max) / size)
    }
}

//! One method with one step on one problem: what is played, and what is measured of it.

use super::course::Course;
use cpu_time::ThreadTime;
use serde::{Deserialize, Serialize};
use surefoot_mechanics::integrators::StepError;
use surefoot_sim::mechanism::StartFailure;

/// When a motion is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// s
    pub duration_s: f64,
    /// Places are compared at so many times, evenly spaced, the last at the end.
    pub samples: u32,
}

/// How finely a motion is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Level {
    /// Steps between two samples, or within a tick.
    pub divisions: u32,
    /// For methods that choose their steps.
    pub tolerance: Option<f64>,
}

/// A failure of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Failed {
    /// s
    pub time_s: f64,
    /// Why.
    pub reason: String,
}

impl From<StepError> for Failed {
    fn from(error: StepError) -> Self {
        Self { time_s: error.time_s, reason: error.to_string() }
    }
}

impl From<StartFailure> for Failed {
    fn from(failure: StartFailure) -> Self {
        Self { time_s: 0.0, reason: failure.to_string() }
    }
}

/// A run, as deterministic as its method.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Played {
    /// Where it was at the samples.
    pub places: Vec<Vec<f64>>,
    /// Times (s) and energies (J), where energy is conserved.
    pub energies: Vec<[f64; 2]>,
    /// Largest change of the conserved momentum over its size, where there is one.
    pub momentum_drift: Option<f64>,
    /// Largest constraint, where the method has constraints.
    pub constraint: Option<f64>,
    /// Steps made.
    pub steps: u64,
    /// Evaluations of residuals or of differential equations.
    pub evaluations: u64,
    /// Newton iterations: mean and most of a step.
    pub newton: Option<(f64, u32)>,
    /// Steps that had to be made in shorter ones.
    pub split_steps: u64,
    /// Why it ended early.
    pub failure: Option<Failed>,
}

/// Energy is looked at in so many steps at most.
const ENERGY_SAMPLES: u64 = 2000;

/// Plays a course to the end of the span.
pub fn play(course: &mut dyn Course, span: &Span, divisions: u32) -> Played {
    let mut played = Played::default();
    if let Err(error) = advance(course, span, divisions, &mut played) {
        played.failure = Some(error.into());
    }
    let progress = course.progress();
    played.steps = progress.steps;
    played.evaluations = progress.evaluations;
    played.split_steps = progress.split_steps;
    if progress.iterations > 0 {
        played.newton = Some((progress.mean_iterations(), progress.most_iterations));
    }
    played
}

fn advance(
    course: &mut dyn Course,
    span: &Span,
    divisions: u32,
    played: &mut Played,
) -> Result<(), StepError> {
    let steps = u64::from(span.samples) * u64::from(divisions);
    let every = steps.div_ceil(ENERGY_SAMPLES);
    let first = course.conserved()?.momentum;
    let size = first.iter().map(|m| m * m).sum::<f64>().sqrt();
    for step in 0..=steps {
        if step > 0 {
            course.step()?;
        }
        if step.is_multiple_of(every) {
            let now = course.conserved()?;
            played.energies.push([course.progress().time_s, now.energy]);
            played.constraint = Some(played.constraint.unwrap_or(0.0).max(now.constraint));
            if size > 1e-12 {
                let change = now.momentum.iter().zip(&first).map(|(a, b)| (a - b).powi(2));
                let drift = change.sum::<f64>().sqrt() / size;
                played.momentum_drift = Some(played.momentum_drift.unwrap_or(0.0).max(drift));
            }
        }
        if step > 0 && step.is_multiple_of(u64::from(divisions)) {
            played.places.push(course.place()?);
        }
    }
    Ok(())
}

/// Makes all steps and nothing else. Seconds of this thread that it took; none where it fails.
pub fn time(course: &mut dyn Course, span: &Span, divisions: u32) -> Option<f64> {
    let steps = u64::from(span.samples) * u64::from(divisions);
    let begun = ThreadTime::now();
    for _ in 0..steps {
        course.step().ok()?;
    }
    Some(begun.elapsed().as_secs_f64())
}

/// Computing time a simulated second: of the thread, so that it stands still while others have the
/// processor.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Timing {
    /// Median of the repeats, s.
    pub median: f64,
    /// The quickest, s: what the least disturbed repeat took.
    pub least: f64,
    /// Between the quartiles, over the median.
    pub spread: f64,
    /// How many.
    pub repeats: u32,
}

impl Timing {
    /// Of several repeats; none of none.
    pub fn of(mut times: Vec<f64>) -> Option<Self> {
        times.sort_by(f64::total_cmp);
        let at = |share: f64| times.get((share * (times.len() as f64 - 1.0)).round() as usize);
        let (median, least) = (*at(0.5)?, *times.first()?);
        let spread = (at(0.75)? - at(0.25)?) / median;
        Some(Self { median, least, spread, repeats: times.len() as u32 })
    }

    /// Whether the spread is too wide to trust the median: over a quarter.
    pub fn is_doubtful(&self) -> bool {
        self.spread > 0.25
    }
}

/// What was measured of a method with a step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Measurement {
    /// Step, s; the mean one of a method that chooses its steps.
    pub step_s: f64,
    /// Steps between samples, or within a tick.
    pub divisions: u32,
    /// Of a method that chooses its steps.
    pub tolerance: Option<f64>,
    /// Computing time a simulated second.
    pub time: Option<Timing>,
    /// Evaluations a simulated second.
    pub evaluations: f64,
    /// Newton iterations a step, mean.
    pub newton_mean: Option<f64>,
    /// The same, most.
    pub newton_most: Option<u32>,
    /// Steps that had to be made in shorter ones.
    pub split_steps: u64,
    /// Largest distance from the reference over the size of its motion.
    pub error: Option<f64>,
    /// Largest less least energy, J.
    pub energy_band_j: Option<f64>,
    /// Slope of energy's straight line, J/s.
    pub energy_slope_j_s: Option<f64>,
    /// Largest change of momentum over its size.
    pub momentum_drift: Option<f64>,
    /// Largest constraint.
    pub constraint: Option<f64>,
    /// Why the run failed, if it did.
    pub failure: Option<Failed>,
}

/// Largest distance of places from a reference's, over the largest distance of the reference from its own
/// mean place; none where places are missing or not finite.
pub fn distance(places: &[Vec<f64>], reference: &[Vec<f64>]) -> Option<f64> {
    if places.len() != reference.len() {
        return None;
    }
    let apart =
        |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| (x - y).powi(2)).sum::<f64>().sqrt();
    let width = reference.first()?.len();
    let mean: Vec<f64> = (0..width)
        .map(|i| reference.iter().map(|place| place[i]).sum::<f64>() / reference.len() as f64)
        .collect();
    let size = reference.iter().map(|place| apart(place, &mean)).fold(0.0, f64::max);
    let mut largest = 0.0_f64;
    for (place, exact) in places.iter().zip(reference) {
        let off = apart(place, exact);
        // `max` would lose a NaN.
        if !(off <= largest) {
            largest = off;
        }
    }
    let error = largest / size.max(f64::MIN_POSITIVE);
    error.is_finite().then_some(error)
}

/// Band and slope of energies over the whole record.
pub fn band_and_slope(energies: &[[f64; 2]]) -> Option<(f64, f64)> {
    let first = energies.first()?[1];
    let n = energies.len() as f64;
    let (low, high) = energies
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), [_, e]| (a.min(*e), b.max(*e)));
    let mean_t = energies.iter().map(|[t, _]| t).sum::<f64>() / n;
    let mean_e = energies.iter().map(|[_, e]| e - first).sum::<f64>() / n;
    let variance: f64 = energies.iter().map(|[t, _]| (t - mean_t).powi(2)).sum();
    let along: f64 = energies.iter().map(|[t, e]| (t - mean_t) * (e - first - mean_e)).sum();
    (variance > 0.0).then(|| (high - low, along / variance))
}

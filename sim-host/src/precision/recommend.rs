//! Which method and which step, for an accuracy that is wanted.
//!
//! The rule: of each method the longest step whose error, and that of all shorter ones, is at most half of
//! what is wanted ([`ERROR_MARGIN`]), read between measured steps on logarithmic axes, and at most
//! [`STEP_MARGIN`] of the shortest step at which it fails and of the longest one that is foretold to work,
//! whichever is shorter; of all methods the one that then takes the least time.

use super::measure::Measurement;
use super::sweep::Curve;
use serde::{Deserialize, Serialize};

/// Share of the wanted accuracy that the expected error may have.
pub const ERROR_MARGIN: f64 = 0.5;
/// Share of the shortest step that fails, or of the longest one foretold to work.
pub const STEP_MARGIN: f64 = 0.7;

/// A method and a step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Choice {
    /// Which method.
    pub method: String,
    /// s; the mean one of a method that chooses its steps.
    pub step_s: f64,
    /// Of a method that chooses its steps.
    pub tolerance: Option<f64>,
    /// What its error should be, relative.
    pub error: f64,
    /// Computing time a simulated second that it should take, s; none where nothing was timed.
    pub time_s: Option<f64>,
    /// Evaluations a simulated second.
    pub evaluations: f64,
    /// The shortest step that fails, s, if one does.
    pub fails_from_s: Option<f64>,
    /// The longest step foretold to work, s, where that was asked for and something is foretold.
    pub foretold_s: Option<f64>,
}

impl Choice {
    /// The shorter of the step seen to fail and the one foretold, s.
    pub fn limit_s(&self) -> Option<f64> {
        shorter(self.fails_from_s, self.foretold_s)
    }
}

fn shorter(a: Option<f64>, b: Option<f64>) -> Option<f64> {
    a.into_iter().chain(b).min_by(f64::total_cmp)
}

/// The shortest step of a curve that fails, s. A method that chooses its steps has none: with a tolerance
/// that is too loose it fails at steps of any length.
fn fails_from(curve: &Curve) -> Option<f64> {
    let failing =
        curve.measurements.iter().filter(|m| m.failure.is_some() && m.tolerance.is_none());
    failing.map(|m| m.step_s).min_by(f64::total_cmp)
}

/// The longest step of a method that is accurate enough; none where no step tried is.
pub fn longest(curve: &Curve, accuracy: f64) -> Option<Choice> {
    let wanted = ERROR_MARGIN * accuracy;
    let fails_from_s = fails_from(curve);
    let foretold_s = curve.foretold_s;
    let most = shorter(fails_from_s, foretold_s).map_or(f64::INFINITY, |h| STEP_MARGIN * h);
    let error = |m: &Measurement| m.error.filter(|_| m.failure.is_none());
    let fits = |m: &Measurement| error(m).is_some_and(|e| e <= wanted) && m.step_s <= most;
    // From the finest on, as long as all are fine.
    let fine = curve.measurements.iter().rev().take_while(|m| fits(m)).count();
    let first = curve.measurements.len() - fine;
    let last_fine = curve.measurements.get(first)?;
    let own = Reading::of(last_fine)?;
    let between = first
        .checked_sub(1)
        .and_then(|coarser| Reading::of(&curve.measurements[coarser]))
        .filter(|coarser| coarser.error > wanted && coarser.step_s <= most)
        .filter(|coarser| coarser.time_s.is_some() == own.time_s.is_some());
    // An adaptive method's tolerance is chosen among those tried: it is no step.
    let read = match between {
        Some(coarser) if last_fine.tolerance.is_none() => own.towards(&coarser, wanted),
        _ => own,
    };
    Some(Choice {
        method: curve.method.clone(),
        step_s: read.step_s,
        tolerance: last_fine.tolerance,
        error: read.error,
        time_s: read.time_s,
        evaluations: read.evaluations,
        fails_from_s,
        foretold_s,
    })
}

/// All methods that are accurate enough at some step, by the time that they then take, or, where nothing
/// was timed, by evaluations.
pub fn ranked(curves: &[Curve], accuracy: f64) -> Vec<Choice> {
    let mut all: Vec<Choice> = curves.iter().filter_map(|curve| longest(curve, accuracy)).collect();
    let cost = |choice: &Choice| choice.time_s.unwrap_or(choice.evaluations);
    all.sort_by(|a, b| cost(a).total_cmp(&cost(b)));
    all
}

/// A point of a curve.
#[derive(Clone, Copy)]
struct Reading {
    step_s: f64,
    error: f64,
    time_s: Option<f64>,
    evaluations: f64,
}

impl Reading {
    fn of(m: &Measurement) -> Option<Self> {
        let error = m.error.filter(|_| m.failure.is_none())?;
        Some(Self {
            step_s: m.step_s,
            error: error.max(f64::MIN_POSITIVE),
            time_s: m.time.map(|time| time.median),
            evaluations: m.evaluations,
        })
    }

    /// Between two points, where the error is what is wanted.
    fn towards(&self, coarser: &Self, wanted: f64) -> Self {
        let share = (wanted / self.error).ln() / (coarser.error / self.error).ln();
        let between = |fine: f64, coarse: f64| fine * (coarse / fine).powf(share);
        Self {
            step_s: between(self.step_s, coarser.step_s),
            error: wanted,
            time_s: self.time_s.zip(coarser.time_s).map(|(a, b)| between(a, b)),
            evaluations: between(self.evaluations, coarser.evaluations),
        }
    }
}

//! A method on a problem, from the coarsest step to the finest that is worth its time.

use super::contender::Contender;
use super::measure::{Failed, Level, Measurement, Played, Timing, band_and_slope, distance};
use super::problem::Problem;
use super::reference::Reference;
use super::slope::{Fit, fitted};
use serde::{Deserialize, Serialize};

/// How much work a sweep may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// Evaluations of a run at most: decides how fine steps become, the same on every machine.
    pub most_evaluations: u64,
    /// Timed runs at least; none for no times at all.
    pub repeats: u32,
    /// They go on for so long, s.
    pub timed_s: f64,
}

impl Effort {
    /// That of the chart.
    pub const CHART: Self = Self { most_evaluations: 100_000, repeats: 5, timed_s: 0.05 };
    /// That of an advice.
    pub const ADVICE: Self = Self { most_evaluations: 40_000, repeats: 5, timed_s: 0.02 };

    /// Runs of so many times the work.
    pub(crate) fn times(self, factor: u64) -> Self {
        Self { most_evaluations: self.most_evaluations.saturating_mul(factor), ..self }
    }
}

/// A method's measurements on a problem.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Curve {
    /// Which method.
    pub method: String,
    /// Its known order.
    pub order: Option<u32>,
    /// The order found.
    pub fit: Option<Fit>,
    /// Coarsest first.
    pub measurements: Vec<Measurement>,
    /// The longest step foretold to work, s, where that was asked for and something is foretold.
    pub foretold_s: Option<f64>,
}

/// Repeats of short runs at most.
const MOST_REPEATS: u32 = 200;
/// A motion that is off by more, relative to how far it reaches, is none.
const DIVERGED: f64 = 10.0;
/// Errors within this multiple of the reference's own are no errors of the method.
const ABOVE_FLOOR: f64 = 5.0;
/// Larger errors are worth making smaller, whatever the reference.
const SMALL: f64 = 1e-3;

/// Measures a contender at its levels.
pub fn sweep(
    problem: &Problem,
    contender: &Contender,
    reference: &Reference,
    effort: &Effort,
) -> Curve {
    let mut measurements = Vec::new();
    let mut at_floor = 0;
    for level in contender.levels.iter().copied() {
        let played = contender.runs.play(&problem.span, level);
        let evaluations = played.evaluations;
        let made = measured(problem, contender, level, played, reference);
        let timing = made.failure.is_none().then(|| timed(problem, contender, level, effort));
        // Where the reference itself is not sure, nothing is at its floor.
        let floor = (ABOVE_FLOOR * reference.apart).min(SMALL);
        let is_fine = made.error.is_some_and(|error| error < floor);
        measurements.push(Measurement { time: timing.flatten(), ..made });
        at_floor += u32::from(is_fine);
        // Levels are apart by at most two; an adaptive method's by less.
        if at_floor >= 2 || 2 * evaluations > effort.most_evaluations {
            break;
        }
    }
    let fit = match contender.order {
        Some(_) => fitted(&measurements, reference.apart),
        None => None,
    };
    let (method, order) = (contender.name.clone(), contender.order);
    Curve { method, order, fit, measurements, foretold_s: None }
}

/// Median of several runs.
pub fn timed(
    problem: &Problem,
    contender: &Contender,
    level: Level,
    effort: &Effort,
) -> Option<Timing> {
    let (mut times, mut sum) = (Vec::new(), 0.0);
    while effort.repeats > 0
        && (times.len() < effort.repeats as usize
            || sum < effort.timed_s && times.len() < MOST_REPEATS as usize)
    {
        let seconds = contender.runs.time(&problem.span, level)?;
        sum += seconds;
        times.push(seconds / problem.span.duration_s);
    }
    Timing::of(times)
}

/// All but the time.
pub fn measured(
    problem: &Problem,
    contender: &Contender,
    level: Level,
    played: Played,
    reference: &Reference,
) -> Measurement {
    let exact = match &reference.second {
        Some(second) if reference.by == contender.name => second,
        _ => &reference.places,
    };
    let error = distance(&played.places, exact).filter(|_| played.failure.is_none());
    let failure = played.failure.or_else(|| match error {
        Some(error) if error <= DIVERGED => None,
        // Beyond any place that the motion has.
        _ => Some(Failed {
            time_s: problem.span.duration_s,
            reason: "the motion diverged".to_owned(),
        }),
    });
    let is_whole = failure.is_none();
    let energies = if problem.keeps_energy && is_whole { &played.energies[..] } else { &[] };
    let energy = band_and_slope(energies);
    let mut step_s = contender.runs.step_s(&problem.span, level);
    if level.tolerance.is_some() {
        // Dormand and Prince's method has twelve stages.
        step_s = 12.0 * problem.span.duration_s / played.evaluations.max(12) as f64;
    }
    Measurement {
        step_s,
        divisions: level.divisions,
        tolerance: level.tolerance,
        time: None,
        evaluations: played.evaluations as f64 / problem.span.duration_s,
        newton_mean: played.newton.map(|(mean, _)| mean),
        newton_most: played.newton.map(|(_, most)| most),
        split_steps: played.split_steps,
        error: error.filter(|_| is_whole),
        energy_band_j: energy.map(|(band, _)| band),
        energy_slope_j_s: energy.map(|(_, slope)| slope),
        momentum_drift: played.momentum_drift.filter(|_| is_whole),
        constraint: played.constraint.filter(|_| is_whole && problem.keeps_energy),
        failure,
    }
}

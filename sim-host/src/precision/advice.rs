//! The method and step for a scene and an accuracy, tried out before it is given.

use super::contender::Contender;
use super::measure::{Level, Measurement};
use super::problem::{Omission, Problem};
use super::recommend::{Choice, ranked};
use super::reference::{NoReference, Reference, reference};
use super::sweep::{Curve, Effort, measured, sweep, timed};
use serde::Serialize;
use surefoot_mechanics::integrators::{ADAPTIVE_TOLERANCE, Method};
use surefoot_sim::scene::Integrator;

/// An advice.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Advice {
    /// Which scene.
    pub problem: String,
    /// Wanted, relative.
    pub accuracy: f64,
    /// What to take.
    pub choice: Choice,
    /// What the choice gave when it was tried.
    pub tried: Measurement,
    /// The next best methods, quickest first.
    pub others: Vec<Choice>,
    /// Methods that are not accurate enough at any step tried.
    pub too_coarse: Vec<String>,
    /// Methods that do not take the scene.
    pub omitted: Vec<Omission>,
    /// What errors are distances from, and what it was checked by.
    pub reference: [String; 2],
    /// How far the two are apart, relative.
    pub apart: f64,
}

/// Why there is no advice.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum AdviceError {
    /// Nothing is known to compare with.
    #[error(transparent)]
    Reference(#[from] NoReference),
    /// The reference is not good enough to tell.
    #[error(
        "{problem}: two methods at their best differ by {apart:.1e} of the motion, so that an accuracy of \
         {accuracy:.1e} cannot be told; ask for less, or for a shorter duration"
    )]
    Unsure {
        /// Which scene.
        problem: String,
        /// How far they are apart.
        apart: f64,
        /// Wanted.
        accuracy: f64,
    },
    /// No method is accurate enough.
    #[error(
        "{problem}: no method reaches {accuracy:.1e} with the steps tried; the best comes to {best:.1e}"
    )]
    OutOfReach {
        /// Which scene.
        problem: String,
        /// Wanted.
        accuracy: f64,
        /// The least error.
        best: f64,
    },
}

/// The reference must be so much better than what is wanted.
const SURE: f64 = 10.0;
/// A choice that misses what is wanted is made finer so often.
const CORRECTIONS: u32 = 4;

/// Which methods are asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Among {
    /// All.
    All,
    /// Those of `run`, which leaves a record of every step: methods with steps of their own. Where none of them is
    /// accurate enough, the adaptive one as it is there, at its finest tolerance between [`RECORDED`] instants.
    Run,
    /// One of these.
    Only(Method),
}

impl Among {
    fn asks(self, contender: &Contender) -> bool {
        match self {
            Self::All => true,
            Self::Run => !contender.is_adaptive() && named(&contender.name).is_some(),
            Self::Only(method) => !contender.is_adaptive() && contender.name == method.name(),
        }
    }

    fn falls_back_on(self, contender: &Contender) -> bool {
        contender.is_adaptive()
            && match self {
                Self::All => false,
                Self::Run => true,
                Self::Only(method) => contender.name == method.name(),
            }
    }
}

/// The method of a name, if it is one of `run`.
fn named(name: &str) -> Option<Method> {
    Method::all().iter().copied().find(|method| method.name() == name)
}

impl Advice {
    /// What `run` takes; none of an adaptive method at a tolerance that it does not have there, and of a form that
    /// is no method there.
    pub fn integrator(&self) -> Option<Integrator> {
        let is_there =
            self.choice.tolerance.is_none_or(|tolerance| tolerance <= ADAPTIVE_TOLERANCE);
        let name = named(&self.choice.method).filter(|_| is_there)?;
        Some(Integrator { name, step_s: self.choice.step_s })
    }
}

/// Advises on a problem for an accuracy, relative to how far the motion reaches.
///
/// # Errors
/// An [`AdviceError`].
///
/// # Cost
/// All methods at some twenty steps: seconds to a minute.
pub fn advise(
    problem: &Problem,
    accuracy: f64,
    among: Among,
    effort: &Effort,
) -> Result<Advice, AdviceError> {
    let exact = reference(problem, effort.most_evaluations)?;
    if !(SURE * exact.apart <= accuracy) {
        let (problem, apart) = (problem.name.clone(), exact.apart);
        return Err(AdviceError::Unsure { problem, apart, accuracy });
    }
    let asked: Vec<&Contender> = problem.contenders.iter().filter(|c| among.asks(c)).collect();
    let effort = &match among {
        // One alone may work as much as all.
        Among::Only(_) => effort.times(problem.contenders.len() as u64),
        Among::All | Among::Run => *effort,
    };
    let mut curves: Vec<Curve> =
        asked.iter().map(|contender| sweep(problem, contender, &exact, effort)).collect();
    let all = foretold(&asked, &mut curves, accuracy);
    let is_ranked = |name: &String| all.iter().any(|choice| choice.method == *name);
    let too_coarse = curves.iter().map(|c| c.method.clone()).filter(|n| !is_ranked(n)).collect();
    let found = all.iter().enumerate().find_map(|(place, choice)| {
        let contender = *asked.iter().find(|c| c.name == choice.method)?;
        let (level, tried) = tried(problem, contender, choice, &exact, accuracy)?;
        let time = timed(problem, contender, level, effort);
        let mut others = all.clone();
        others.remove(place);
        let choice = Choice { step_s: tried.step_s, ..choice.clone() };
        Some((choice, Measurement { time, ..tried }, others))
    });
    let fallback = || {
        let contender = problem.contenders.iter().find(|c| among.falls_back_on(c))?;
        let (choice, tried) = at_its_finest(problem, contender, &exact, accuracy, effort)?;
        Some((choice, tried, Vec::new()))
    };
    if let Some((choice, tried, others)) = found.or_else(fallback) {
        return Ok(Advice {
            problem: problem.name.clone(),
            accuracy,
            choice,
            tried,
            others,
            too_coarse,
            omitted: problem.omitted.clone(),
            reference: [exact.by, exact.checked_by],
            apart: exact.apart,
        });
    }
    let errors = curves.iter().flat_map(|curve| &curve.measurements).filter_map(|m| m.error);
    let best = errors.fold(f64::INFINITY, f64::min);
    Err(AdviceError::OutOfReach { problem: problem.name.clone(), accuracy, best })
}

/// All that are accurate enough, quickest first, the first with its limit foretold: to foretell all would take
/// longer than to measure them.
fn foretold(asked: &[&Contender], curves: &mut [Curve], accuracy: f64) -> Vec<Choice> {
    let mut is_foretold = vec![false; curves.len()];
    loop {
        let all = ranked(curves, accuracy);
        let first =
            all.first().and_then(|first| curves.iter().position(|c| c.method == first.method));
        // Each turn foretells one more.
        match first.filter(|k| !is_foretold[*k]) {
            None => return all,
            Some(k) => {
                curves[k].foretold_s = (asked[k].foretell)();
                is_foretold[k] = true;
            }
        }
    }
}

/// Instants that `run` records of an adaptive method, unless a step is named.
pub const RECORDED: u32 = 1000;

/// An adaptive method as `run` has it, if that is accurate enough.
fn at_its_finest(
    problem: &Problem,
    contender: &Contender,
    exact: &Reference,
    accuracy: f64,
    effort: &Effort,
) -> Option<(Choice, Measurement)> {
    let divisions = RECORDED.div_ceil(problem.span.samples);
    let level = Level { divisions, tolerance: Some(ADAPTIVE_TOLERANCE) };
    let played = contender.runs.play(&problem.span, level);
    let made = measured(problem, contender, level, played, exact);
    let error = made.error.filter(|error| made.failure.is_none() && *error <= accuracy)?;
    let time = timed(problem, contender, level, effort);
    let choice = Choice {
        method: contender.name.clone(),
        step_s: contender.runs.step_s(&problem.span, level),
        tolerance: level.tolerance,
        error,
        time_s: time.map(|time| time.median),
        evaluations: made.evaluations,
        fails_from_s: None,
        foretold_s: None,
    };
    Some((choice, Measurement { time, ..made }))
}

/// The choice as whole steps, made finer until it is what was wanted.
fn tried(
    problem: &Problem,
    contender: &Contender,
    choice: &Choice,
    exact: &Reference,
    accuracy: f64,
) -> Option<(Level, Measurement)> {
    let coarsest = Level { divisions: 1, tolerance: choice.tolerance };
    let whole = contender.runs.step_s(&problem.span, coarsest) / choice.step_s;
    let mut level = coarsest;
    if choice.tolerance.is_none() {
        // A whole number reads as a little more than it is.
        level.divisions = (whole - 1e-6).ceil().max(1.0) as u32;
    }
    for _ in 0..=CORRECTIONS {
        let played = contender.runs.play(&problem.span, level);
        let made = measured(problem, contender, level, played, exact);
        if made.failure.is_none() && made.error.is_some_and(|error| error <= accuracy) {
            return Some((level, made));
        }
        match &mut level.tolerance {
            Some(tolerance) => *tolerance *= 0.5,
            None => level.divisions = level.divisions.saturating_mul(5).div_ceil(4),
        }
    }
    None
}

//! A geometric scan of steps for one method on one problem, and of all on all.

use super::catalogue::problems;
use super::problem::Problem;
use super::store::{PartStoreError, Parts, ScanStore};
use super::tally::Tally;
use super::tree_catalogue::{TreeProblemError, tree_problems};
use serde::{Deserialize, Serialize};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use surefoot_mechanics::forecast::{FailureKind, Verdict};
use surefoot_mechanics::integrators::Method;

/// Ratio of neighbours in a scan of everything.
pub const RATIO: f64 = 1.02;

/// What was found for a method on a problem.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Limit {
    /// Which problem.
    pub problem: String,
    /// Which method.
    pub method: Method,
    /// The last step before the first that fails, s; none if the shortest fails.
    pub works_to_s: Option<f64>,
    /// The first that fails, s; none if all work.
    pub fails_from_s: Option<f64>,
    /// How it fails.
    pub kind: Option<FailureKind>,
    /// The longest that works, beyond some that fail, s.
    pub longest_s: Option<f64>,
    /// What was foretold, s; none where no step should work, or all should.
    pub forecast_s: Option<f64>,
    /// How longer steps were foretold to fail; none where all should work.
    pub forecast_kind: Option<FailureKind>,
}

/// A forecast beside what was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Agreement {
    /// Found over foretold: below 1 the forecast was too bold.
    Ratio(f64),
    /// Nothing limits the method, and nothing was foretold to.
    Unlimited,
    /// No step works, as foretold.
    NoneWorks,
    /// A limit was foretold, and all steps work.
    TooCautious,
    /// A step was foretold to work, and none does, or none of a length that the forecast allows.
    TooBold,
}

impl Limit {
    /// The forecast beside what was found.
    pub fn agreement(&self) -> Agreement {
        match (self.works_to_s, self.fails_from_s, self.forecast_s, self.forecast_kind) {
            (Some(_), None, None, None) => Agreement::Unlimited,
            (Some(_), None, None, Some(_)) => Agreement::TooCautious,
            (Some(works), None, Some(foretold), _) if works > 2.0 * foretold => {
                Agreement::TooCautious
            }
            (Some(works), _, Some(foretold), _) => Agreement::Ratio(works / foretold),
            (None, _, None, Some(_)) => Agreement::NoneWorks,
            (Some(_), Some(_), None, Some(_)) => Agreement::TooCautious,
            (_, Some(_), None, None) | (None, _, Some(_), _) => Agreement::TooBold,
            (None, None, None, None) => Agreement::Unlimited,
        }
    }
}

impl Agreement {
    /// Whether it is within a factor of two.
    pub fn is_near(self) -> bool {
        match self {
            Self::Ratio(ratio) => (0.5..=2.0).contains(&ratio),
            Self::Unlimited | Self::NoneWorks => true,
            Self::TooCautious | Self::TooBold => false,
        }
    }

    /// Whether the forecast is too long by more than a tenth.
    pub fn is_unsafe(self) -> bool {
        match self {
            Self::Ratio(ratio) => ratio < 1.0 / 1.1,
            Self::TooBold => true,
            _ => false,
        }
    }
}

/// All limits.
#[derive(Clone, Debug, Serialize)]
pub struct Scan {
    /// Ratio of neighbouring steps.
    pub ratio: f64,
    /// Problems' names, and what they are.
    pub problems: Vec<(&'static str, &'static str)>,
    /// One for each method and problem that go together.
    pub limits: Vec<Limit>,
}

/// Scans one method on one problem, with steps in a ratio; `None` if it is not made for it.
pub fn scan_one(problem: &Problem, method: Method, ratio: f64) -> Option<Limit> {
    let forecast = problem.forecast(method)?;
    let mut limit = Limit {
        problem: problem.name.to_owned(),
        method,
        works_to_s: None,
        fails_from_s: None,
        kind: None,
        longest_s: None,
        forecast_s: forecast.step_s,
        forecast_kind: forecast.kind,
    };
    for h in steps(problem, ratio) {
        match problem.attempt(method, h)? {
            Verdict::Works => {
                limit.longest_s = Some(h);
                if limit.fails_from_s.is_none() {
                    limit.works_to_s = Some(h);
                }
            }
            Verdict::Fails { kind, .. } if limit.fails_from_s.is_none() => {
                (limit.fails_from_s, limit.kind) = (Some(h), Some(kind));
            }
            Verdict::Fails { .. } => {}
        }
    }
    Some(limit)
}

/// Steps in a ratio, the shortest first; those below a period go into it a whole number of times.
fn steps(problem: &Problem, ratio: f64) -> Vec<f64> {
    let [shortest, longest] = problem.range_s;
    let all = std::iter::successors(Some(shortest), |h| Some(h * ratio));
    // Round-off must not cost the longest.
    let all = all.take_while(|h| *h <= longest * (1.0 + 1e-9));
    let Some(period_s) = problem.period_s else { return all.collect() };
    let shortened = |h: f64| match h < period_s {
        true => period_s / (period_s / h - 1e-9).ceil(),
        false => h,
    };
    let mut steps: Vec<f64> = all.map(shortened).collect();
    steps.dedup();
    steps
}

/// All problems whose limits are sought.
///
/// # Errors
/// Never for the catalogue as shipped.
pub fn all_problems() -> Result<Vec<Problem>, TreeProblemError> {
    let mut all = problems();
    all.extend(tree_problems()?);
    Ok(all)
}

impl Scan {
    /// How many forecasts hold.
    pub fn tally(&self) -> Tally {
        self.limits.iter().map(Limit::agreement).collect()
    }
}

/// Scans on all processors what the store has not, and keeps each limit there as soon as it is found; `done`
/// hears of each finished share of the work, of how many. The result does not depend on what was there before.
///
/// # Errors
/// The first error of the store; no other scan is begun then.
pub fn scan_problems(
    problems: &[Problem],
    ratio: f64,
    store: &ScanStore,
    done: &(dyn Fn(usize, usize) + Sync),
) -> Result<Scan, PartStoreError> {
    let known = store.finished()?;
    let work: Vec<(&Problem, usize, Method)> = problems
        .iter()
        .flat_map(|problem| {
            Method::all().iter().enumerate().map(move |(number, method)| (problem, number, *method))
        })
        .collect();
    let missing: Vec<_> = work
        .iter()
        .filter(|(problem, number, _)| {
            known.get(problem.name).is_none_or(|limits| !limits.contains_key(number))
        })
        .collect();
    let found_before = work.len() - missing.len();
    done(found_before, work.len());
    let (next, finished) = (AtomicUsize::new(0), AtomicUsize::new(found_before));
    let known: Mutex<(Parts<Limit>, Option<PartStoreError>)> = Mutex::new((known, None));
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..workers.min(missing.len()) {
            scope.spawn(|| {
                while let Some((problem, number, method)) =
                    missing.get(next.fetch_add(1, Ordering::Relaxed))
                {
                    let limit = scan_one(problem, *method, ratio);
                    let Ok(mut known) = known.lock() else { break };
                    let (limits, error) = &mut *known;
                    if let Some(limit) = limit {
                        limits.entry(problem.name.to_owned()).or_default().insert(*number, limit);
                        if let Err(why) = store.keep(limits) {
                            error.get_or_insert(why);
                            next.store(missing.len(), Ordering::Relaxed);
                            break;
                        }
                    }
                    done(finished.fetch_add(1, Ordering::Relaxed) + 1, work.len());
                }
            });
        }
    });
    // A thread that panicked has taken the whole program with it.
    let (mut limits, error) = known.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    match error {
        Some(error) => Err(error),
        None => Ok(Scan {
            ratio,
            problems: problems.iter().map(|each| (each.name, each.description)).collect(),
            limits: problems
                .iter()
                .flat_map(|each| limits.remove(each.name).unwrap_or_default().into_values())
                .collect(),
        }),
    }
}

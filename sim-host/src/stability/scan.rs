//! A geometric scan of steps for one method on one problem, and of all on all.

use super::catalogue::problems;
use super::forecast::forecast;
use super::problem::Problem;
use super::verdict::{FailureKind, Verdict};
use crate::integrators::Method;
use serde::Serialize;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The shortest step tried, s.
const SHORTEST: f64 = 0.005;
/// The longest step tried, s.
const LONGEST: f64 = 1.5;
/// Ratio of neighbours in a scan of everything.
const RATIO: f64 = 1.02;

/// What was found for a method on a problem.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Limit {
    /// Which problem.
    pub problem: &'static str,
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
    /// What was foretold, s.
    pub forecast_s: Option<f64>,
}

/// All limits.
#[derive(Clone, Debug, Serialize)]
pub struct Scan {
    /// Ratio of neighbouring steps.
    pub ratio: f64,
    /// One for each method and problem that go together.
    pub limits: Vec<Limit>,
}

/// Scans one method on one problem, with steps in a ratio; `None` if it is not made for it.
pub fn scan_one(problem: &Problem, method: Method, ratio: f64) -> Option<Limit> {
    let mut limit = Limit {
        problem: problem.name,
        method,
        works_to_s: None,
        fails_from_s: None,
        kind: None,
        longest_s: None,
        forecast_s: forecast(method, &problem.rates),
    };
    let mut h = SHORTEST;
    while h <= LONGEST {
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
        h *= ratio;
    }
    Some(limit)
}

/// Scans everything on all processors; `done` hears of each finished share of the work, of how many.
pub fn scan(done: &(dyn Fn(usize, usize) + Sync)) -> Scan {
    let problems = problems();
    let work: Vec<(&Problem, Method)> = problems
        .iter()
        .flat_map(|problem| Method::all().iter().map(move |method| (problem, *method)))
        .collect();
    let (next, finished) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let found: Mutex<Vec<(usize, Limit)>> = Mutex::new(Vec::new());
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|| {
                loop {
                    let at = next.fetch_add(1, Ordering::Relaxed);
                    let Some((problem, method)) = work.get(at) else { break };
                    if let Some(limit) = scan_one(problem, *method, RATIO)
                        && let Ok(mut found) = found.lock()
                    {
                        found.push((at, limit));
                    }
                    done(finished.fetch_add(1, Ordering::Relaxed) + 1, work.len());
                }
            });
        }
    });
    let mut found = found.into_inner().unwrap_or_default();
    found.sort_by_key(|(at, _)| *at);
    Scan { ratio: RATIO, limits: found.into_iter().map(|(_, limit)| limit).collect() }
}

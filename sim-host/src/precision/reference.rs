//! What is exact about a problem, as nearly as can be told, by two methods that share nothing.
//!
//! Errors are distances from the first; its own method's are from the second. How far the two are apart is
//! the floor below which no error means anything. Where the second is of low order it can only confirm the
//! first as far as it has itself converged: then all errors are from the first, and the floor is what halving
//! its finest step changes.

use super::contender::Contender;
use super::measure::{Level, Span, distance};
use super::problem::Problem;
use serde::{Deserialize, Serialize};
use surefoot_mechanics::integrators::Method;

/// A reference.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reference {
    /// Where it is at the samples.
    pub places: Vec<Vec<f64>>,
    /// What made it.
    pub by: String,
    /// The same of another method, for the errors of the first.
    pub second: Option<Vec<Vec<f64>>>,
    /// What made that, or how the first was checked.
    pub checked_by: String,
    /// How far the two are apart, relative.
    pub apart: f64,
}

/// Why there is none.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(
    "{problem}: no method comes to an end with any step tried, so that nothing is known to compare with"
)]
pub struct NoReference {
    /// Which problem.
    pub problem: String,
}

/// Methods by how near to round-off they come for the work they take.
fn rank(name: &str) -> usize {
    let all = [Method::DormandPrince8, Method::Yoshida6, Method::Yoshida4, Method::RungeKutta4];
    all.iter().position(|method| method.name() == name).unwrap_or(all.len())
}

/// A method of first order is as far from its limit as its last halving changed it; this allows for twice
/// that, and for luck.
const CONFIRMED: f64 = 3.0;

/// The references' share of evaluations, over that of what is measured.
const CARE: u64 = 10;

/// Looks for a problem's reference.
///
/// # Errors
/// [`NoReference`].
///
/// # Cost
/// Up to some ten times `most_evaluations`.
pub fn reference(problem: &Problem, most_evaluations: u64) -> Result<Reference, NoReference> {
    if let Some(exact) = &problem.closed_form {
        return Ok(Reference {
            places: exact(&problem.span),
            by: "closed form".to_owned(),
            second: None,
            checked_by: "nothing, as none is needed".to_owned(),
            // Of sines and exponentials.
            apart: 1e-14,
        });
    }
    let mut ranked: Vec<&Contender> = problem.contenders.iter().collect();
    ranked.sort_by_key(|contender| rank(&contender.name));
    let mut found = ranked.into_iter().filter_map(|contender| {
        let converged = converged(contender, &problem.span, CARE * most_evaluations)?;
        Some((contender.name.clone(), converged))
    });
    let (by, first) = found.next().ok_or(NoReference { problem: problem.name.clone() })?;
    let Some((checked_by, second)) = found.next() else {
        return Ok(Reference {
            places: first.places,
            by,
            second: None,
            checked_by: "itself with steps twice as long".to_owned(),
            apart: first.apart,
        });
    };
    let apart = distance(&second.places, &first.places).unwrap_or(f64::INFINITY);
    if first.apart < apart && apart <= CONFIRMED * second.unsteady {
        let checked_by = format!(
            "{checked_by}, which at its finest step is {apart:.1e} away and has changed by {:.1e} in its last \
             halvings",
            second.unsteady
        );
        return Ok(Reference {
            places: first.places,
            by,
            second: None,
            checked_by,
            apart: first.apart,
        });
    }
    Ok(Reference { places: first.places, by, second: Some(second.places), checked_by, apart })
}

struct Converged {
    places: Vec<Vec<f64>>,
    /// From the same, half as fine.
    apart: f64,
    /// The largest such change of the last three: across contacts one may be small by chance.
    unsteady: f64,
}

/// Finer and finer until nothing changes any more, or round-off has the last word.
fn converged(contender: &Contender, span: &Span, most_evaluations: u64) -> Option<Converged> {
    let doubled: Vec<Level> = if contender.is_adaptive() {
        contender.levels.iter().rev().take(1).copied().collect()
    } else {
        let is_power = |l: &&Level| l.divisions.is_power_of_two();
        contender.levels.iter().filter(is_power).copied().collect()
    };
    let mut best: Option<Converged> = None;
    let mut changes: Vec<f64> = Vec::new();
    for level in doubled {
        let played = contender.runs.play(span, level);
        if played.failure.is_some() {
            continue;
        }
        let Some(last) = &best else {
            best = Some(Converged {
                places: played.places,
                apart: f64::INFINITY,
                unsteady: f64::INFINITY,
            });
            continue;
        };
        let Some(apart) = distance(&played.places, &last.places) else { continue };
        if apart > last.apart && last.apart < 1e-6 {
            break;
        }
        changes.push(apart);
        let recent = &changes[changes.len().saturating_sub(3)..];
        let unsteady = recent.iter().copied().fold(0.0, f64::max);
        best = Some(Converged { places: played.places, apart, unsteady });
        if apart < 1e-14 || 2 * played.evaluations > most_evaluations {
            break;
        }
    }
    best
}

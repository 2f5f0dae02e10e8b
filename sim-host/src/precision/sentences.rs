//! What charts show, in words made from the data.

use super::recommend::{Choice, ranked};
use super::survey::Survey;
use super::sweep::Curve;
use std::fmt::Write;

/// Accuracies that are spoken of.
pub const ACCURACIES: [f64; 4] = [1e-2, 1e-4, 1e-6, 1e-8];

/// Who is quickest for each accuracy, and by how much.
pub fn quickest(survey: &Survey) -> String {
    let mut text = String::new();
    for accuracy in ACCURACIES {
        let all = ranked(&survey.curves, accuracy);
        let Some(first) = all.first() else {
            let _ = write!(text, "For {accuracy:.0e} no method tried is fine enough. ");
            continue;
        };
        let _ = write!(
            text,
            "For {accuracy:.0e}: {} at {} ({})",
            first.method,
            step(first),
            cost(first)
        );
        if let Some(second) = all.get(1) {
            let _ =
                write!(text, ", {:.1} times quicker than {}", ratio(second, first), second.method);
        }
        text.push_str(". ");
    }
    text
}

/// Where the simulator's own method loses, and by how much.
pub fn losses(survey: &Survey) -> String {
    let own = "variational";
    let mut text = String::new();
    for accuracy in ACCURACIES {
        let all = ranked(&survey.curves, accuracy);
        let Some(first) = all.first().filter(|first| first.method != own) else { continue };
        let _ = match all.iter().find(|choice| choice.method == own) {
            Some(ours) => write!(
                text,
                "At {accuracy:.0e} the plain variational method takes {:.1} times the time of {}. ",
                ratio(ours, first),
                first.method
            ),
            None => write!(
                text,
                "The plain variational method does not reach {accuracy:.0e} with the steps tried; {} does. ",
                first.method
            ),
        };
    }
    text
}

/// Who is quicker, the methods here or those of other simulators, and by how much.
pub fn peers(survey: &Survey) -> String {
    let mut text = String::new();
    if survey.peers.is_empty() {
        return text;
    }
    for accuracy in ACCURACIES {
        let (ours, theirs) = (ranked(&survey.curves, accuracy), ranked(&survey.peers, accuracy));
        let _ = match (ours.first(), theirs.first()) {
            (Some(own), Some(other)) if ratio(other, own) >= 1.0 => {
                let times = ratio(other, own);
                write!(
                    text,
                    "At {accuracy:.0e} {} takes {times:.1} times the time of {}. ",
                    other.method, own.method
                )
            }
            (Some(own), Some(other)) => {
                let times = ratio(own, other);
                write!(
                    text,
                    "At {accuracy:.0e} {} takes {times:.1} times the time of {}. ",
                    own.method, other.method
                )
            }
            (Some(own), None) => {
                write!(
                    text,
                    "At {accuracy:.0e} only methods here get there, {} first. ",
                    own.method
                )
            }
            (None, Some(other)) => {
                write!(text, "At {accuracy:.0e} only {} gets there. ", other.method)
            }
            (None, None) => Ok(()),
        };
    }
    text
}

/// Slopes beside known orders.
pub fn slopes(survey: &Survey) -> String {
    let each = survey.curves.iter().chain(&survey.peers).filter_map(|curve| {
        let known = curve.order?;
        Some(match curve.fit {
            Some(fit) => format!("{} {:.2} (known: {known})", curve.method, fit.order),
            None => format!("{} has too few clean points", curve.method),
        })
    });
    format!("Fitted slopes: {}.", each.collect::<Vec<_>>().join("; "))
}

/// The range of a quantity over all steps that work, method by method.
pub fn ranges(
    survey: &Survey,
    what: &str,
    of: impl Fn(&super::Measurement) -> Option<f64>,
) -> String {
    let each = survey.curves.iter().chain(&survey.peers).filter_map(|curve| {
        let values: Vec<f64> = curve.measurements.iter().filter_map(&of).map(f64::abs).collect();
        let low = values.iter().copied().reduce(f64::min)?;
        let high = values.iter().copied().reduce(f64::max)?;
        Some(format!("{} {low:.1e} to {high:.1e}", curve.method))
    });
    let each: Vec<String> = each.collect();
    if each.is_empty() { String::new() } else { format!("{what}: {}.", each.join("; ")) }
}

/// Points that failed, curve by curve.
pub fn failures(curve: &Curve) -> Vec<String> {
    let failed = curve.measurements.iter().filter_map(|m| {
        let failure = m.failure.as_ref()?;
        Some(format!("{} at {:.3e} s: {}", curve.method, m.step_s, failure.reason))
    });
    failed.collect()
}

/// Points whose times are too far apart to trust, as steps.
pub fn doubtful(survey: &Survey) -> String {
    let all = survey.curves.iter().chain(&survey.peers).flat_map(|curve| &curve.measurements);
    let timed: Vec<_> = all.filter_map(|m| m.time).collect();
    let wide = timed.iter().filter(|time| time.is_doubtful()).count();
    let widest = timed.iter().map(|time| time.spread).fold(0.0, f64::max);
    format!(
        "Times are medians of at least {} runs; {wide} of {} spread over more than 25 % between their quartiles \
         (at most {:.0} %), and are marked with ~ in the table.",
        timed.iter().map(|time| time.repeats).min().unwrap_or(0),
        timed.len(),
        100.0 * widest
    )
}

/// A step for people.
pub fn step(choice: &Choice) -> String {
    match choice.tolerance {
        Some(tolerance) => format!("a tolerance of {tolerance:.1e}"),
        None => format!("steps of {:.2e} s", choice.step_s),
    }
}

/// What a choice costs, for people.
pub fn cost(choice: &Choice) -> String {
    match choice.time_s {
        Some(time) => format!("{:.3} ms a simulated second", 1e3 * time),
        None => format!("{:.0} evaluations a simulated second", choice.evaluations),
    }
}

fn ratio(slow: &Choice, quick: &Choice) -> f64 {
    match slow.time_s.zip(quick.time_s) {
        Some((slow, quick)) => slow / quick,
        None => slow.evaluations / quick.evaluations,
    }
}

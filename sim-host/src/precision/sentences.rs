//! What charts show, in words made from the data.

use super::recommend::{Choice, ranked};
use super::survey::Survey;
use super::sweep::Curve;
use std::fmt::Write;

/// The simulator's own method.
const OWN: &str = "variational";
/// How near a fitted slope is to the order that it shows.
const CLEAN: f64 = 0.3;

/// Accuracies that are spoken of.
pub const ACCURACIES: [f64; 4] = [1e-2, 1e-4, 1e-6, 1e-8];

/// Methods that stand out in a survey's charts: those that are quickest for some accuracy, and the simulator's own.
pub fn stand_out(survey: &Survey) -> Vec<String> {
    let mut all: Vec<String> = first_for_each(survey).into_iter().map(|(_, name)| name).collect();
    all.extend(survey.curves.iter().map(|c| c.method.clone()).filter(|name| name == OWN));
    all
}

/// The quickest method for each accuracy that some method reaches.
fn first_for_each(survey: &Survey) -> Vec<(f64, String)> {
    let first = |accuracy: &f64| {
        let all = ranked(&survey.curves, *accuracy);
        Some((*accuracy, all.into_iter().next()?.method))
    };
    ACCURACIES.iter().filter_map(first).collect()
}

/// Who is quickest up to which accuracy.
pub fn frontier(survey: &Survey) -> String {
    let first = first_for_each(survey);
    let spans = first.chunk_by(|a, b| a.1 == b.1).map(|span| match span {
        [(accuracy, name)] => format!("{name} to {accuracy:.0e}"),
        [(from, name), .., (to, _)] => format!("{name} from {from:.0e} to {to:.0e}"),
        [] => String::new(),
    });
    let spans: Vec<String> = spans.collect();
    if spans.is_empty() {
        "No method tried is fine enough for any accuracy asked for.".to_owned()
    } else {
        format!("Quickest: {}.", spans.join(", "))
    }
}

/// Who is quickest over all problems, accuracy by accuracy.
pub fn over_all(surveys: &[Survey]) -> String {
    let spans = ACCURACIES[..3].iter().filter_map(|accuracy| {
        let mut first: Vec<String> = surveys
            .iter()
            .filter_map(|survey| Some(ranked(&survey.curves, *accuracy).into_iter().next()?.method))
            .collect();
        first.sort();
        let mut counted: Vec<(usize, &str)> =
            first.chunk_by(|a, b| a == b).map(|same| (same.len(), same[0].as_str())).collect();
        counted.sort_by_key(|(count, _)| std::cmp::Reverse(*count));
        let named: Vec<String> =
            counted.iter().map(|(count, name)| format!("{name} {count}")).collect();
        (!named.is_empty()).then(|| format!("to {accuracy:.0e} {}", named.join(", ")))
    });
    let spans: Vec<String> = spans.collect();
    format!("quickest, in how many of {} scenes: {}.", surveys.len(), spans.join("; "))
}

/// How many methods show the order that they are known for.
pub fn orders(survey: &Survey) -> String {
    let known = || survey.curves.iter().filter_map(|curve| Some((curve, f64::from(curve.order?))));
    let holds = |(curve, order): &(&Curve, f64)| {
        curve.fit.is_some_and(|fit| (fit.order - order).abs() <= CLEAN)
    };
    let others: Vec<&str> =
        known().filter(|one| !holds(one)).map(|(curve, _)| curve.method.as_str()).collect();
    let others = match others.as_slice() {
        [] => String::new(),
        others => format!("; not so {}", others.join(", ")),
    };
    format!(
        "{} of {} methods show their known order within {CLEAN}{others}.",
        known().filter(holds).count(),
        known().count()
    )
}

/// Which methods keep a quantity lowest, and which let it go furthest.
pub fn extremes(survey: &Survey, of: impl Fn(&super::Measurement) -> Option<f64>) -> String {
    let most = |curve: &Curve| {
        let values = curve.measurements.iter().filter_map(&of).map(f64::abs);
        Some((values.reduce(f64::max)?, curve.method.clone()))
    };
    let all: Vec<(f64, String)> = survey.curves.iter().filter_map(most).collect();
    let low = all.iter().min_by(|a, b| a.0.total_cmp(&b.0));
    let high = all.iter().max_by(|a, b| a.0.total_cmp(&b.0));
    match low.zip(high) {
        Some((low, high)) if low.1 == high.1 => format!("{}: at most {}.", low.1, plain(low.0)),
        Some((low, high)) => format!(
            "Lowest: {}, at most {}; highest: {}, up to {}.",
            low.1,
            plain(low.0),
            high.1,
            plain(high.0)
        ),
        None => String::new(),
    }
}

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
    let mut text = String::new();
    for accuracy in ACCURACIES {
        let all = ranked(&survey.curves, accuracy);
        let Some(first) = all.first().filter(|first| first.method != OWN) else { continue };
        let _ = match all.iter().find(|choice| choice.method == OWN) {
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
        Some(format!("{} {} to {}", curve.method, plain(low), plain(high)))
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

/// Two digits, as a power of ten only where that is shorter.
fn plain(value: f64) -> String {
    if (0.1..1000.0).contains(&value) { format!("{value:.1}") } else { format!("{value:.1e}") }
}

fn ratio(slow: &Choice, quick: &Choice) -> f64 {
    match slow.time_s.zip(quick.time_s) {
        Some((slow, quick)) => slow / quick,
        None => slow.evaluations / quick.evaluations,
    }
}

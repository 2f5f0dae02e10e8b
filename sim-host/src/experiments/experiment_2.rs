//! Experiment 2 (§4.3): what the text prints of the block, the heels, and the way back.

use super::comparison::{Asked, Comparison};
use super::foot_events::{first, longest_apart};
use surefoot_sim::closed_loop::Run;
use surefoot_sim::record::EventKind;

/// Printed figures of Experiment 2 beside those of a run; empty for a run without samples.
///
/// The heels rise and fall with their longest interval off the floor: shorter ones are bounces.
pub fn experiment_2(run: &Run) -> Vec<Comparison> {
    if run.samples.is_empty() {
        return Vec::new();
    }
    let [left, right] = ["left foot", "right foot"]
        .map(|foot| longest_apart(run, foot, EventKind::HeelOff, EventKind::HeelDown));
    let begin = |heel: Option<(f64, f64)>| heel.map(|(from, _)| from);
    let rise = match (begin(left), begin(right)) {
        (Some(left), Some(right)) => Some(left.min(right)),
        (left, right) => left.or(right),
    };
    let end = |heel: Option<(f64, f64)>| heel.map(|(_, to)| to);
    vec![
        Comparison::new("the block strikes the body", "s", first(run, EventKind::Strike), 0.08),
        Comparison::new("the feet begin to rise", "s", rise, 0.13),
        Comparison::new("the right foot is down again", "s", end(right), 0.36),
        Comparison::new("the left foot is down again", "s", end(left), 0.38),
    ]
}

/// The rows that belong to one of the eight figures, by its place among them.
pub(super) fn rows_of_figure(figure: usize, run: &Run) -> Vec<Comparison> {
    let Some(last) = run.samples.last() else { return Vec::new() };
    let final_place = |name: &str, i: usize, printed: f64| {
        Comparison::new(format!("final {name}"), "cm", 1e2 * last.positions[i], printed)
            .asked(Asked::Absolute(0.1))
    };
    match figure {
        0 => experiment_2(run),
        2 => vec![final_place("x", 0, -1.0), final_place("y", 1, 0.0), final_place("z", 2, 114.0)],
        _ => Vec::new(),
    }
}

//! Where forecasts that ask yes or no change their mind.

use super::axis::Axis;
use super::column::Foretold;
use surefoot_mechanics::forecast::SHARE;

/// Bisections between the ends of an axis: to a hundredth of it.
const BISECTIONS: usize = 7;
/// Cells of a climb, and bisections between two of them.
const CLIMB: usize = 80;
const BISECTIONS_OF_A_CELL: usize = 2;

/// The least of two edges, with the margin of all forecasts: that of a question whose answer changes once, and
/// that of one with islands, which is asked all the way up.
pub(in crate::stability) fn edge(
    axis: &Axis,
    once: impl Fn(f64) -> bool,
    with_islands: impl Fn(f64) -> bool,
) -> Foretold {
    match before_failure(axis, with_islands) {
        Some(None) => Foretold::NothingWorks,
        Some(Some(works)) => bisected(axis, works, &once),
        None if once(axis.to) => Foretold::Unlimited,
        None => bisected(axis, axis.to, &once),
    }
}

fn bisected(axis: &Axis, high: f64, works: &impl Fn(f64) -> bool) -> Foretold {
    if works(high) {
        return Foretold::At(SHARE * high);
    }
    if !works(axis.from) {
        return Foretold::NothingWorks;
    }
    Foretold::At(SHARE * halved(axis, (axis.from, high), BISECTIONS, works))
}

/// The last value of a climb before the first that fails, if there is one before it; none if all work.
fn before_failure(axis: &Axis, works: impl Fn(f64) -> bool) -> Option<Option<f64>> {
    let values: Vec<f64> = axis.cells(CLIMB).values().collect();
    let first = values.iter().position(|value| !works(*value))?;
    Some(
        first
            .checked_sub(1)
            .map(|last| halved(axis, (values[last], values[first]), BISECTIONS_OF_A_CELL, &works)),
    )
}

/// The lower of two values, of which it works and the higher does not, after so many bisections.
fn halved(
    axis: &Axis,
    (mut low, mut high): (f64, f64),
    times: usize,
    works: &impl Fn(f64) -> bool,
) -> f64 {
    for _ in 0..times {
        let middle = axis.between(low, high);
        *(if works(middle) { &mut low } else { &mut high }) = middle;
    }
    low
}

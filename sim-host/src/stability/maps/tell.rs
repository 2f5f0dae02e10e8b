//! What a map says, in a sentence that is made from its cells.

use super::column::{Column, Foretold, Map};
use super::outcome::Outcome;
use crate::stability::{Agreement, Tally};

/// How many columns' forecasts hold.
pub fn tally(map: &Map, columns: &[Column]) -> Tally {
    columns.iter().map(|column| map.agreement(column)).collect()
}

/// What a map shows at a glance: where its edge is, or that it has none.
pub fn glance(map: &Map, columns: &[Column]) -> String {
    let edge = edge(map, columns);
    if edge.is_empty() { "No cell fails.".to_owned() } else { edge.trim_start().to_owned() }
}

/// What a map says.
pub fn tell(map: &Map, columns: &[Column]) -> String {
    let cells = || columns.iter().flat_map(|column| &column.cells);
    let works = cells().filter(|cell| **cell == Outcome::Works).count();
    let failures = Column::count_failures(columns);
    let mut text = format!("{works} of {} cells work", cells().count());
    if failures.is_empty() {
        text += ".";
    } else {
        let kinds: Vec<String> =
            failures.iter().map(|(kind, count)| format!("{} ({count})", kind.words())).collect();
        text += &format!("; the others fail by {}.", kinds.join(", "));
    }
    text += &edge(map, columns);
    let islands = columns.iter().filter(|column| has_island(column)).count();
    if islands > 0 {
        let columns =
            if islands == 1 { "1 column".to_owned() } else { format!("{islands} columns") };
        text += &format!(" In {columns} something works again beyond the first failure.");
    }
    let counts = tally(map, columns);
    let told = columns.iter().filter(|column| column.foretold != Foretold::Unlimited).count();
    let limits = if told == 0 { "No limit was foretold; that is" } else { "The forecast is" };
    text + &format!(
        " {limits} within a factor of two in {} of {} columns, and more than 10 % too long in {}{}.",
        counts.within_a_factor_of_two,
        counts.forecasts,
        counts.unsafe_by_more_than_a_tenth,
        worst(map, columns),
    )
}

/// Where the edge is, and how it goes with `x` where that is a power.
fn edge(map: &Map, columns: &[Column]) -> String {
    let edges: Vec<(f64, f64)> = columns
        .iter()
        .filter(|column| column.fails_from.is_some())
        .filter_map(|column| Some((column.x, column.works_to?)))
        .collect();
    let Some(low) = edges.iter().map(|edge| edge.1).reduce(f64::min) else { return String::new() };
    let high = edges.iter().map(|edge| edge.1).fold(low, f64::max);
    let shown = |y: f64| format!("{} {}", significant(y * map.y.shown), map.y.unit);
    let (low, high) = (shown(low).trim_end().to_owned(), shown(high).trim_end().to_owned());
    let mut text = if low == high {
        format!(" The edge is at a {} of {low}", map.y.name)
    } else {
        format!(" The edge is at a {} of {low} to {high}", map.y.name)
    };
    if map.x.is_logarithmic && map.y.is_logarithmic && edges.len() * 2 > columns.len() {
        let logarithms: Vec<(f64, f64)> = edges.iter().map(|(x, y)| (x.ln(), y.ln())).collect();
        if let Some((slope, off)) = line(&logarithms) {
            // A power says something only where it holds within a fifth.
            if off < 0.2 && slope.abs() < 0.05 {
                text += &format!(", whatever the {}", map.x.name);
            } else if off < 0.2 {
                text += &format!(", as the power {slope:.2} of the {}", map.x.name);
            }
        }
    }
    text + "."
}

/// Slope of the best line, and the points' largest distance from it.
fn line(points: &[(f64, f64)]) -> Option<(f64, f64)> {
    let n = points.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / n;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let spread: f64 = points.iter().map(|p| (p.0 - x).powi(2)).sum();
    let slope = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum::<f64>() / spread;
    let off = points.iter().map(|p| (p.1 - y - slope * (p.0 - x)).abs()).fold(0.0, f64::max);
    (points.len() >= 3 && slope.is_finite()).then_some((slope, off))
}

fn has_island(column: &Column) -> bool {
    let first = column.cells.iter().position(|cell| *cell != Outcome::Works);
    first.is_some_and(|first| column.cells[first..].contains(&Outcome::Works))
}

/// The least and the greatest ratio of found to foretold.
fn worst(map: &Map, columns: &[Column]) -> String {
    let ratios = columns.iter().filter_map(|column| match map.agreement(column) {
        Agreement::Ratio(ratio) => Some(ratio),
        _ => None,
    });
    let (low, high) = ratios.fold((f64::INFINITY, 0.0_f64), |(l, h), r| (l.min(r), h.max(r)));
    if high == 0.0 {
        return String::new();
    }
    format!(" (found over foretold: {low:.2} to {high:.2})")
}

/// Three digits.
pub fn significant(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let digits = (2 - value.abs().log10().floor() as i32).clamp(0, 9) as usize;
    let text = format!("{value:.digits$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

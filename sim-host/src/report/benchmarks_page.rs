//! The page of public benchmark problems.

use crate::benchmarks::{Played, Row};
use crate::chart::{Bar, Bars, ChartError, XyChart, XySeries};
use askama::Template;

/// Texts are escaped by the template, but for the style and drawings, which are the program's.
#[derive(Template)]
#[template(path = "benchmarks.html")]
struct Page<'a> {
    style: &'static str,
    met: usize,
    bars: String,
    rows: Vec<Written<'a>>,
}

struct Written<'a> {
    name: &'a str,
    method: &'a str,
    step: String,
    error: String,
    bar: String,
    meets: &'static str,
    mujoco: String,
    measure: &'a str,
    reference: &'a str,
    reason: &'a str,
    drawing: String,
}

/// Why there is no page.
#[derive(Debug, thiserror::Error)]
pub enum PageError {
    /// The template cannot be written.
    #[error(transparent)]
    Template(#[from] askama::Error),
    /// A drawing cannot be made.
    #[error(transparent)]
    Chart(#[from] ChartError),
}

/// Draws the page.
///
/// # Errors
/// A [`PageError`].
pub fn benchmarks_page(rows: &[Row]) -> Result<String, PageError> {
    let bar = |row: &Row| {
        let value = row.error.map(|error| error / row.bar);
        let label = value.map_or_else(|| "none".to_owned(), |value| format!("{value:.1e}"));
        Bar { name: row.name.to_owned(), value: value.map(|value| value.max(1e-12)), label }
    };
    let title = "Error over what is good enough";
    let bars = Bars::new(title, rows.iter().map(bar).collect()).logarithmic();
    let page = Page {
        style: concat!(include_str!("page.css"), include_str!("charts.css")),
        met: rows.iter().filter(|row| row.meets).count(),
        bars: in_page(&Bars::svg(&[bars])?),
        rows: rows.iter().map(written).collect::<Result<_, _>>()?,
    };
    Ok(page.render()?)
}

fn written(row: &Row) -> Result<Written<'_>, ChartError> {
    let number = |x: Option<f64>| x.map_or_else(|| "none".to_owned(), |x| format!("{x:.1e}"));
    let drawing = match &row.played {
        Some(played) if !played.traces.is_empty() => in_page(&paths(row.name, played).svg()?),
        _ => String::new(),
    };
    Ok(Written {
        name: row.name,
        method: row.method.as_deref().unwrap_or("none"),
        step: number(row.step_s),
        error: number(row.error),
        bar: format!("{:.0e}", row.bar),
        meets: if row.meets { "yes" } else { "no" },
        mujoco: row.peers.get("mujoco").map_or_else(String::new, |peer| number(peer.error)),
        measure: row.measure,
        reference: &row.reference,
        reason: row.reason.as_deref().unwrap_or(""),
        drawing,
    })
}

/// A drawing made for a file, which in a page needs no namespace.
fn in_page(svg: &str) -> String {
    svg.replacen(" xmlns=\"http://www.w3.org/2000/svg\"", "", 1)
}

/// Bodies that are drawn at most.
const MOST: usize = 8;

/// Paths of the mass centres, seen along the axis in which they move least, and the energy below.
fn paths(name: &str, played: &Played) -> XyChart {
    let coordinate = |k: usize, axis: usize| {
        played.traces.iter().filter_map(move |t| t.configuration.get(7 * k + axis).copied())
    };
    let bodies = played.bodies.len().min(MOST);
    let reach = |axis: usize| -> f64 {
        let widths = (0..bodies).map(|k| {
            let (low, high) = coordinate(k, axis)
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
            high - low
        });
        widths.fold(0.0, f64::max)
    };
    let least = (0..3).min_by(|a, b| reach(*a).total_cmp(&reach(*b))).unwrap_or(1);
    let (across, up) = match least {
        0 => (1, 2),
        1 => (0, 2),
        _ => (0, 1),
    };
    let axis = |k: usize| ["x, m", "y, m", "z, m"][k];
    let series = (0..bodies).map(|k| {
        XySeries::curve(played.bodies[k].as_str(), coordinate(k, across).zip(coordinate(k, up)))
    });
    let first = played.traces.first().map_or(0.0, |trace| trace.energy);
    let energy = played.traces.iter().map(|trace| (trace.time_s, trace.energy - first));
    let below =
        XyChart::new("change of energy", "t, s", "J").with(vec![XySeries::curve("energy", energy)]);
    XyChart::new(name, axis(across), axis(up)).with(series.collect()).below(below)
}

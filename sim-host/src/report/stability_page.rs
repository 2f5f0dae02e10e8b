//! One page with all maps and tables of `chart stability`, which needs nothing but itself.

use askama::Template;

/// A map as it stands in the page.
pub struct MapFigure {
    /// SVG.
    pub drawing: String,
    /// What it says.
    pub says: String,
    /// What works.
    pub note: String,
}

/// The longest steps of all methods on a problem.
pub struct StepTable {
    /// The problem.
    pub name: String,
    /// What it is.
    pub description: String,
    /// A row a method.
    pub rows: Vec<StepRow>,
}

/// A method's longest step.
pub struct StepRow {
    /// Its name.
    pub method: String,
    /// The longest step, with its unit.
    pub works_to: String,
    /// How longer ones fail.
    pub fails_by: String,
    /// The step foretold, with its unit.
    pub foretold: String,
    /// How longer ones were foretold to fail.
    pub foretold_by: String,
    /// Found over foretold.
    pub ratio: String,
}

/// How many forecasts hold: a sentence each, empty where there is nothing to count.
pub struct ForecastCounts {
    /// Of everything.
    pub all: String,
    /// Of all maps' columns.
    pub maps: String,
    /// Of all longest steps.
    pub steps: String,
}

/// Texts are escaped by the template, but for the style, which comes with the program, and drawings, whose
/// backend escapes.
#[derive(Template)]
#[template(path = "stability.html")]
struct Page<'a> {
    style: &'static str,
    maps: &'a [MapFigure],
    tables: &'a [StepTable],
    counts: &'a ForecastCounts,
}

/// Draws the page. `counts` says how many forecasts hold.
///
/// # Errors
/// [`askama::Error`] if it cannot be written.
pub fn stability_page(
    maps: &[MapFigure],
    tables: &[StepTable],
    counts: &ForecastCounts,
) -> Result<String, askama::Error> {
    Page { style: include_str!("page.css"), maps, tables, counts }.render()
}

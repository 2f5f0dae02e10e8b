//! What `chart stability` tells: maps, and tables of longest steps.

use super::{Chapter, Figure};
use askama::Template;

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
    /// Of all maps' columns.
    pub maps: String,
    /// Of all longest steps.
    pub steps: String,
}

/// Texts are escaped by the template, but for drawings, whose backend escapes.
#[derive(Template)]
#[template(path = "stability_chapter.html")]
struct Body<'a> {
    maps: &'a [Figure],
    tables: &'a [StepTable],
    counts: &'a ForecastCounts,
}

/// Puts it together. `headline` says how many forecasts hold in all.
///
/// # Errors
/// [`askama::Error`] if it cannot be written.
pub fn stability_chapter(
    maps: &[Figure],
    tables: &[StepTable],
    counts: &ForecastCounts,
    headline: String,
) -> Result<Chapter, askama::Error> {
    let body = Body { maps, tables, counts }.render()?;
    Ok(Chapter {
        id: "stability",
        title: "Where methods and loops fail".to_owned(),
        headline,
        body,
    })
}

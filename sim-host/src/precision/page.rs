//! One page of all surveys that needs no network.

use super::controller::ControllerPrecision;
use super::controller_figures::controller_figures;
use super::figures::{PrecisionFigure, figures};
use super::recommend::{ERROR_MARGIN, STEP_MARGIN, ranked};
use super::sentences::{self, ACCURACIES};
use super::survey::Survey;
use crate::chart::ChartError;
use askama::Template;

/// Why there is no page.
#[derive(Debug, thiserror::Error)]
pub enum PrecisionPageFailure {
    /// A chart.
    #[error(transparent)]
    Chart(#[from] ChartError),
    /// The page itself.
    #[error("the page cannot be written: {0}")]
    Template(#[from] askama::Error),
}

/// Texts are escaped by the template, but for the style and the drawings.
#[derive(Template)]
#[template(path = "work_precision.html")]
struct Page<'a> {
    machine: &'a str,
    error_margin: f64,
    step_margin: f64,
    sections: Vec<Section<'a>>,
    controller: Vec<PrecisionFigure>,
    uncounted: &'a str,
    style: &'static str,
}

struct Section<'a> {
    survey: &'a Survey,
    recommended: Vec<Row>,
    losses: String,
    peers: String,
    doubtful: String,
    figures: Vec<PrecisionFigure>,
    failures: Vec<String>,
}

/// A recommended method and step.
struct Row {
    accuracy: String,
    method: String,
    step: String,
    cost: String,
    limit: String,
    next: String,
}

/// Draws the page.
///
/// # Errors
/// A [`PrecisionPageFailure`].
pub fn page(
    surveys: &[Survey],
    controller: &ControllerPrecision,
    machine: &str,
) -> Result<String, PrecisionPageFailure> {
    let section = |survey| -> Result<Section<'_>, ChartError> {
        Ok(Section {
            recommended: recommended(survey),
            losses: sentences::losses(survey),
            peers: sentences::peers(survey),
            doubtful: sentences::doubtful(survey),
            figures: figures(survey)?,
            failures: survey
                .curves
                .iter()
                .chain(&survey.peers)
                .flat_map(sentences::failures)
                .collect(),
            survey,
        })
    };
    let page = Page {
        machine,
        error_margin: ERROR_MARGIN,
        step_margin: STEP_MARGIN,
        controller: controller_figures(controller)?,
        uncounted: controller.uncounted.as_deref().unwrap_or_default(),
        sections: surveys.iter().map(section).collect::<Result<_, _>>()?,
        style: include_str!("../report/page.css"),
    };
    Ok(page.render()?)
}

fn recommended(survey: &Survey) -> Vec<Row> {
    let rows = ACCURACIES.iter().filter_map(|accuracy| {
        let all = ranked(&survey.curves, *accuracy);
        let first = all.first()?;
        let limit = first.limit_s().map(|h| format!("{:.2}", first.step_s / h));
        let next = all.get(1).map(|next| format!("{}, {}", next.method, sentences::cost(next)));
        Some(Row {
            accuracy: format!("{accuracy:.0e}"),
            method: first.method.clone(),
            step: sentences::step(first),
            cost: sentences::cost(first),
            limit: limit
                .unwrap_or_else(|| "no step tried fails, and nothing is foretold".to_owned()),
            next: next.unwrap_or_else(|| "none".to_owned()),
        })
    });
    rows.collect()
}

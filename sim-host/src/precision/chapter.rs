//! What the surveys tell.

use super::controller::ControllerPrecision;
use super::controller_figures::controller_figures;
use super::figures::{PrecisionFigure, figures};
use super::recommend::{ERROR_MARGIN, STEP_MARGIN, ranked};
use super::sentences::{self, ACCURACIES};
use super::survey::Survey;
use crate::chart::ChartError;
use crate::report::{Chapter, Figure};
use askama::Template;

/// Why there is nothing for a page.
#[derive(Debug, thiserror::Error)]
pub enum PrecisionChapterFailure {
    /// A chart.
    #[error(transparent)]
    Chart(#[from] ChartError),
    /// The text.
    #[error("the page cannot be written: {0}")]
    Template(#[from] askama::Error),
}

/// Texts are escaped by the template, but for the drawings.
#[derive(Template)]
#[template(path = "precision_chapter.html")]
struct Body<'a> {
    error_margin: f64,
    step_margin: f64,
    sections: Vec<Section<'a>>,
    controller: Vec<Figure>,
    uncounted: &'a str,
}

struct Section<'a> {
    survey: &'a Survey,
    recommended: Vec<Row>,
    losses: String,
    peers: String,
    doubtful: String,
    /// Error against time, which the others stand below.
    first: Option<Figure>,
    others: Vec<Figure>,
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

/// Puts it together.
///
/// # Errors
/// A [`PrecisionChapterFailure`].
pub fn chapter(
    surveys: &[Survey],
    controller: &ControllerPrecision,
) -> Result<Chapter, PrecisionChapterFailure> {
    let section = |survey| -> Result<Section<'_>, ChartError> {
        let mut shown = figures(survey)?.into_iter().map(|figure| in_page(&survey.problem, figure));
        Ok(Section {
            recommended: recommended(survey),
            losses: sentences::losses(survey),
            peers: sentences::peers(survey),
            doubtful: sentences::doubtful(survey),
            first: shown.next(),
            others: shown.collect(),
            failures: survey
                .curves
                .iter()
                .chain(&survey.peers)
                .flat_map(sentences::failures)
                .collect(),
            survey,
        })
    };
    let drawn = controller_figures(controller)?;
    let body = Body {
        error_margin: ERROR_MARGIN,
        step_margin: STEP_MARGIN,
        controller: drawn.into_iter().map(|figure| in_page("controller", figure)).collect(),
        uncounted: controller.uncounted.as_deref().unwrap_or_default(),
        sections: surveys.iter().map(section).collect::<Result<_, _>>()?,
    };
    Ok(Chapter {
        id: "work-precision",
        title: "What accuracy costs".to_owned(),
        headline: sentences::over_all(surveys),
        body: body.render()?,
    })
}

/// The name of a figure's file.
pub fn file_of(problem: &str, figure: &PrecisionFigure) -> String {
    format!("work-precision-{problem}-{}.svg", figure.name)
}

fn in_page(problem: &str, figure: PrecisionFigure) -> Figure {
    let files =
        [file_of(problem, &figure), "work-precision.csv".into(), "work-precision.json".into()];
    Figure::new(&figure.svg, figure.says, figure.note).with_files(files)
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

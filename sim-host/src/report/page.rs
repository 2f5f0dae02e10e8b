//! The page from its template, whatever moved in the run.

use super::replay_data::ReplayData;
use super::tables::{Fact, Place, Printed};
use crate::chart::ChartError;
use askama::Template;
use surefoot_sim::mechanism::StartFailure;
use surefoot_sim::record::{Event, Record};

/// Why there is no page.
#[derive(Debug, thiserror::Error)]
pub enum PageFailure {
    /// A figure.
    #[error(transparent)]
    Chart(#[from] ChartError),
    /// What the scene is made of.
    #[error(transparent)]
    Start(#[from] StartFailure),
    /// The replay's data.
    #[error("the replay cannot be written: {0}")]
    Replay(#[from] serde_json::Error),
    /// The page itself.
    #[error("the report cannot be written: {0}")]
    Template(#[from] askama::Error),
}

/// The scripts of the replay, as one: what is declared in one is seen by the next.
const SCRIPT: &str = concat!(
    include_str!("view.js"),
    "\n",
    include_str!("replay.js"),
    "\n",
    include_str!("controls.js")
);

/// What a page says of a run.
pub(super) struct Content<'a> {
    pub scene: &'a str,
    pub description: &'a str,
    pub outcome: Word,
    pub failure: Option<FailureText>,
    /// What the user should know of the scene.
    pub warnings: &'a [String],
    pub facts: Vec<Fact>,
    /// Beside these.
    pub sheet: Sheet,
    pub readings: Vec<&'static str>,
    pub printed: Vec<Printed>,
    pub places: Vec<Place>,
    /// SVG as written to files.
    pub figures: Vec<String>,
    /// What marks in figures mean.
    pub figures_note: &'static str,
    /// Below the replay: what arrows, squares and solids mean.
    pub note: String,
    /// Whether a controller's wrench and set point can be shown.
    pub has_controller: bool,
}

/// An outcome in words, and the class of its style.
pub(super) struct Word {
    pub word: &'static str,
    pub class: &'static str,
}

pub(super) struct FailureText {
    pub time: String,
    pub place: String,
    pub advice: String,
}

/// A table of names, values, and something else.
pub(super) struct Sheet {
    pub title: &'static str,
    pub head: [&'static str; 3],
    pub rows: Vec<[String; 3]>,
}

/// A colour and what it stands for.
struct Colour {
    css: &'static str,
    name: String,
}

/// Of the groups of bodies, as the script has them.
const GROUPS: [&str; 3] = ["#0072b2", "#e69f00", "#009e73"];

/// Texts are escaped by the template, but for those that it calls safe: the style and scripts, which come
/// with the program, figures, whose backend escapes, and the data.
#[derive(Template)]
#[template(path = "page.html")]
struct Page<'a> {
    content: &'a Content<'a>,
    figures: Vec<String>,
    legend: Vec<Colour>,
    replay: Option<String>,
    begin: f64,
    end: f64,
    has_block: bool,
    has_points: bool,
    style: &'static str,
    script: &'static str,
}

/// Draws the page.
///
/// # Errors
/// A [`PageFailure`].
pub(super) fn drawn(
    content: &Content<'_>,
    record: &dyn Record,
    events: &[Event],
) -> Result<String, PageFailure> {
    let shown = record.shown();
    let data = ReplayData::of(record, events);
    let ends = data.as_ref().and_then(|data| Some((*data.times.first()?, *data.times.last()?)));
    let (begin, end) = ends.unwrap_or_default();
    let colour = |(group, name): &(u8, String)| Colour {
        css: GROUPS[usize::from(*group) % GROUPS.len()],
        name: name.clone(),
    };
    // In a page drawings need no namespace.
    let plain = |svg: &String| svg.replacen(" xmlns=\"http://www.w3.org/2000/svg\"", "", 1);
    let page = Page {
        content,
        figures: content.figures.iter().map(plain).collect(),
        legend: shown.legend.iter().map(colour).collect(),
        begin,
        end,
        has_block: shown.block.is_some(),
        has_points: data.as_ref().is_some_and(|data| !data.contacts.is_empty()),
        replay: data.map(|data| embedded(&data)).transpose()?,
        style: include_str!("page.css"),
        script: SCRIPT,
    };
    Ok(page.render()?)
}

/// JSON that no markup can end: strings are all that could hold a `<`.
fn embedded(data: &ReplayData) -> Result<String, serde_json::Error> {
    Ok(serde_json::to_string(data)?.replace('<', "\\u003c"))
}

//! The page from its template.

use super::replay_data::ReplayData;
use super::tables::{self, Fact, Peak, Place, Printed};
use crate::chart::{ChartError, RUN_FIGURES};
use crate::closed_loop::{Failure, Outcome, Run};
use crate::experiments::{reading, robot_figures};
use crate::picture::{DESIRED_FORCE_LENGTH, FORCE_LENGTH, Shown, TORQUE_LENGTH};
use crate::robot::Robot;
use crate::scene::{Scene, TorquesFrom};
use askama::Template;

/// All that a page is made from.
#[derive(Clone, Copy, Debug)]
pub struct Report<'a> {
    /// The scene as run.
    pub scene: &'a Scene,
    /// Where the controller ran, and in which precision, for people.
    pub controller: &'a str,
    /// The run.
    pub run: &'a Run,
    /// The run in the other reading of the first instant.
    pub other: Option<&'a (TorquesFrom, Run)>,
}

/// Why there is no page.
#[derive(Debug, thiserror::Error)]
pub enum PageFailure {
    /// A figure.
    #[error(transparent)]
    Chart(#[from] ChartError),
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

/// Texts are escaped by the template, but for those that it calls safe: the style and scripts, which come
/// with the program, figures, whose backend escapes, and the data.
#[derive(Template)]
#[template(path = "page.html")]
struct Page<'a> {
    scene: &'a str,
    description: &'a str,
    outcome: Word,
    failure: Option<FailureText<'a>>,
    facts: Vec<Fact>,
    peaks: Vec<Peak>,
    readings: Vec<&'static str>,
    printed: Vec<Printed>,
    places: Vec<Place>,
    figures: Vec<String>,
    replay: Option<String>,
    begin: f64,
    end: f64,
    has_block: bool,
    has_contacts: bool,
    force_centimetres: f64,
    desired_centimetres: f64,
    torque_centimetres: f64,
    style: &'static str,
    script: &'static str,
}

/// An outcome in words, and the class of its style.
struct Word {
    word: &'static str,
    class: &'static str,
}

struct FailureText<'a> {
    time: String,
    place: &'a str,
    advice: &'a str,
}

/// Draws the page.
///
/// # Errors
/// A [`PageFailure`].
pub fn page(report: &Report<'_>) -> Result<String, PageFailure> {
    let Report { scene, run, other, .. } = report;
    let mut runs = vec![(scene.controller.torques_from, *run)];
    runs.extend(other.iter().map(|(from, run)| (*from, run)));
    let shown = Shown::of(scene);
    let data = ReplayData::of(&shown, &run.samples, &run.events);
    let ends = data.as_ref().and_then(|data| Some((*data.times.first()?, *data.times.last()?)));
    let (begin, end) = ends.unwrap_or_default();
    let page = Page {
        scene: &scene.name,
        description: &scene.description,
        outcome: word(run.outcome),
        failure: run.failure.as_ref().map(failure_text),
        facts: tables::facts(report),
        peaks: tables::peaks(&shown.robot, run),
        readings: runs.iter().map(|(from, _)| reading(*from)).collect(),
        printed: tables::printed(&scene.name, &runs),
        places: tables::places(&run.events),
        figures: figures(&scene.name, &shown.robot, run)?,
        begin,
        end,
        has_block: shown.block.is_some(),
        has_contacts: data.as_ref().is_some_and(|data| !data.contacts.is_empty()),
        replay: data.map(|data| embedded(&data)).transpose()?,
        force_centimetres: (1e4 * FORCE_LENGTH).round(),
        desired_centimetres: (1e4 * DESIRED_FORCE_LENGTH).round(),
        torque_centimetres: (1e3 * TORQUE_LENGTH).round(),
        style: include_str!("page.css"),
        script: SCRIPT,
    };
    Ok(page.render()?)
}

/// JSON that no markup can end: strings are all that could hold a `<`.
fn embedded(data: &ReplayData) -> Result<String, serde_json::Error> {
    Ok(serde_json::to_string(data)?.replace('<', "\\u003c"))
}

/// The figures as they stand in a page, which needs no namespace.
fn figures(scene: &str, robot: &Robot, run: &Run) -> Result<Vec<String>, ChartError> {
    let figure = |svg: String| svg.replacen(" xmlns=\"http://www.w3.org/2000/svg\"", "", 1);
    let of = |place: usize| match robot_figures::number(scene, place) {
        Some(number) => format!("{scene}, as figure {number}"),
        None => scene.to_owned(),
    };
    let charts = RUN_FIGURES.iter().enumerate();
    charts
        .map(|(i, chart)| Ok(figure(chart.svg(&of(i), robot, &run.samples, &run.events)?)))
        .collect()
}

fn word(outcome: Outcome) -> Word {
    let (word, class) = match outcome {
        Outcome::Balanced => ("Balanced", "balanced"),
        Outcome::Completed => ("Completed, but not at the set point", "completed"),
        Outcome::Stopped => ("Stopped by its supervisor", "failed"),
        Outcome::Interrupted => ("Interrupted", "completed"),
        Outcome::Fell => ("Fell", "fell"),
        Outcome::Failed => ("Failed", "failed"),
    };
    Word { word, class }
}

fn failure_text(failure: &Failure) -> FailureText<'_> {
    FailureText {
        time: format!("{:.4}", failure.time_s),
        place: &failure.place,
        advice: &failure.advice,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::closed_loop::{Scalar, controller, run};
    use crate::scene::load;

    fn made(change: impl FnOnce(&mut Scene)) -> (Scene, String) {
        let mut scene = load("experiment-1").expect("a built-in scene");
        scene.duration_s = 0.2;
        change(&mut scene);
        let run = run(&scene, controller(&scene, Scalar::F64).as_mut(), &mut |_| {});
        let report =
            Report { scene: &scene, controller: "f64, on the host", run: &run, other: None };
        let text = page(&report).expect("a page");
        (scene, text)
    }

    fn data(page: &str) -> serde_json::Value {
        let (_, rest) = page.split_once("id=\"replay-data\">").expect("data");
        let (data, _) = rest.split_once("</script>").expect("an end");
        serde_json::from_str(data).expect("JSON")
    }

    #[test]
    fn the_page_needs_nothing_but_itself() {
        let (_, page) = made(|_| {});
        for reference in ["http://", "https://", "src=", "@import", "url(", "<link"] {
            assert!(!page.contains(reference), "{reference}");
        }
    }

    #[test]
    fn the_page_holds_every_figure_and_the_printed_numbers() {
        let (_, page) = made(|_| {});
        assert_eq!(page.matches("<svg").count(), RUN_FIGURES.len());
        for figure in RUN_FIGURES {
            assert!(page.contains(&format!(": {}", figure.title)), "{}", figure.name);
        }
        for text in ["1687 N", "192 N·m", "toe rises", "touches down", "torques from t = 0"] {
            assert!(page.contains(text), "{text}");
        }
    }

    /// 0.2 s of 500 samples a second, of which every third is enough, and the last.
    #[test]
    fn the_replay_has_a_frame_for_each_time() {
        let (_, page) = made(|_| {});
        let data = data(&page);
        let length = |name: &str| data[name].as_array().expect("a list").len();
        let frames = length("times");
        assert_eq!(frames, 35);
        assert_eq!(data["times"][34], 0.2);
        for (name, each) in [("poses", 7 * 13), ("wrench", 6), ("forces", 24), ("errors", 2)] {
            assert_eq!(length(name), each * frames, "{name}");
        }
        assert_eq!(data["contacts"].as_str().expect("digits").len(), 8 * frames);
        // The start: 103.5 cm high.
        assert_eq!(data["poses"][2], 10350);
    }

    #[test]
    fn text_of_a_scene_is_text() {
        let hostile = "</script><script>alert(1)</script><img src=x onerror=alert(2)> & \"'";
        let (_, page) = made(|scene| {
            scene.description = hostile.to_owned();
            scene.name = hostile.to_owned();
        });
        assert!(!page.contains("<script>alert") && !page.contains("<img"));
        assert!(
            page.contains("&#60;script&#62;alert(1)") || page.contains("&lt;script&gt;alert(1)")
        );
    }

    #[test]
    fn a_run_that_failed_says_why_and_plays_what_there_is() {
        let (_, page) = made(|scene| {
            scene.integrator.name = crate::integrators::Method::SemiImplicitEuler;
            scene.integrator.step_s = 1e-3;
        });
        assert!(
            page.contains("Advice:") && page.contains("class=\"outcome fell")
                || page.contains("class=\"outcome failed")
        );
        assert!(!data(&page)["times"].as_array().expect("a list").is_empty());
    }
}

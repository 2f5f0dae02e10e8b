//! The page of a robot's run.

use super::page::{Content, FailureText, PageFailure, Sheet, Word, drawn};
use super::tables;
use crate::chart::{ChartError, RUN_FIGURES};
use crate::experiments::{reading, robot_figures};
use surefoot_sim::closed_loop::{Failure, Outcome, Run};
use surefoot_sim::picture::{DESIRED_FORCE_LENGTH, FORCE_LENGTH, TORQUE_LENGTH};
use surefoot_sim::record::RobotRecord;
use surefoot_sim::robot::Robot;
use surefoot_sim::scene::{Scene, TorquesFrom};

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

/// Draws the page.
///
/// # Errors
/// A [`PageFailure`].
pub fn page(report: &Report<'_>) -> Result<String, PageFailure> {
    let Report { scene, run, other, .. } = report;
    let mut runs = vec![(scene.controller.torques_from, *run)];
    runs.extend(other.iter().map(|(from, run)| (*from, run)));
    let robot = scene.robot();
    let content = Content {
        scene: &scene.name,
        description: &scene.description,
        outcome: word(run),
        failure: run.failure.as_ref().map(failure_text),
        warnings: &[],
        facts: tables::facts(report),
        sheet: Sheet {
            title: "Peaks",
            head: ["of largest size", "value", "at"],
            rows: tables::peaks(&robot, run),
        },
        readings: runs.iter().map(|(from, _)| reading(*from)).collect(),
        printed: tables::printed(&scene.name, &runs),
        places: tables::places(&run.events),
        figures: figures(&scene.name, &robot, run)?,
        figures_note: "Vertical lines mark contact: feet touching down or leaving, heels and toes rising, the block \
                       striking.",
        note: format!(
            "Arrows: {} cm for 100 N, {} cm for 100 N of the desired force, {} cm for 10 N·m; squares of 20 cm. \
             Bodies are boxes of uniform density with the bodies' masses and inertias.",
            (1e4 * FORCE_LENGTH).round(),
            (1e4 * DESIRED_FORCE_LENGTH).round(),
            (1e3 * TORQUE_LENGTH).round(),
        ),
        has_controller: true,
    };
    drawn(&content, &RobotRecord::new(scene, &run.samples), &run.events)
}

/// The figures, those of an experiment with the text's numbers.
fn figures(scene: &str, robot: &Robot, run: &Run) -> Result<Vec<String>, ChartError> {
    let of = |place: usize| match robot_figures::number(scene, place) {
        Some(number) => format!("{scene}, as figure {number}"),
        None => scene.to_owned(),
    };
    let charts = RUN_FIGURES.iter().enumerate();
    charts.map(|(i, chart)| chart.svg(&of(i), robot, &run.samples, &run.events)).collect()
}

fn word(run: &Run) -> Word {
    let (word, class) = match run.outcome {
        Outcome::Balanced => ("Balanced", "balanced"),
        Outcome::Completed if run.gait.is_some() => ("Walked without a fall", "completed"),
        Outcome::Completed => ("Completed, but not at the set point", "completed"),
        Outcome::Stopped => ("Stopped by its supervisor", "failed"),
        Outcome::Interrupted => ("Interrupted", "completed"),
        Outcome::Fell => ("Fell", "fell"),
        Outcome::Failed => ("Failed", "failed"),
    };
    Word { word, class }
}

fn failure_text(failure: &Failure) -> FailureText {
    FailureText {
        time: format!("{:.4}", failure.time_s),
        place: failure.place.clone(),
        advice: failure.advice.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use surefoot_sim::closed_loop::{Scalar, controller, run};
    use surefoot_sim::scene::load;

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
            scene.integrator.name = surefoot_mechanics::integrators::Method::SemiImplicitEuler;
            scene.integrator.step_s = 1e-3;
        });
        assert!(
            page.contains("Advice:") && page.contains("class=\"outcome fell")
                || page.contains("class=\"outcome failed")
        );
        assert!(!data(&page)["times"].as_array().expect("a list").is_empty());
    }
}

//! Figures 4.3 to 4.19: the two experiments of §4.3.

use super::{Comparison, experiment_1, experiment_2};
use crate::chart::{ChartError, RUN_FIGURES};
use surefoot::dynamics::DynamicsFault;
use surefoot_sim::closed_loop::{Run, Scalar, controller, run};
use surefoot_sim::picture::still;
use surefoot_sim::record::RobotRecord;
use surefoot_sim::robot::biped;
use surefoot_sim::scene::{Outline, SceneError, TorquesFrom, load};

/// How figures 4.3 to 4.19 are read.
pub const READING: &str = "torques from touch-down (what the text prints of the first instant fits this \
    reading; it leaves open what the robot does before its feet touch), controller in f64";

/// Figures 4.3 to 4.10: Experiment 1.
pub const EXPERIMENT_1: [&str; 8] = [
    "figure-4.3",
    "figure-4.4",
    "figure-4.5",
    "figure-4.6",
    "figure-4.7",
    "figure-4.8",
    "figure-4.9",
    "figure-4.10",
];

/// Figures 4.11 to 4.19: Experiment 2, of which the first is a picture.
pub const EXPERIMENT_2: [&str; 9] = [
    "figure-4.11",
    "figure-4.12",
    "figure-4.13",
    "figure-4.14",
    "figure-4.15",
    "figure-4.16",
    "figure-4.17",
    "figure-4.18",
    "figure-4.19",
];

/// When figure 4.11 was taken, s.
const PICTURE_TIME: f64 = 0.32;

/// A figure of a robot's run.
pub struct RobotFigure {
    /// Its name on the command line.
    pub name: &'static str,
    /// The drawing.
    pub svg: String,
    /// What can be compared in numbers.
    pub rows: Vec<Comparison>,
}

/// Why there are no figures.
#[derive(Debug, thiserror::Error)]
pub enum RobotFigureFailure {
    /// The scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The run ended early.
    #[error("{scene} failed at {time_s} s: {reason}")]
    Run {
        /// Which scene.
        scene: String,
        /// When.
        time_s: f64,
        /// Why.
        reason: String,
    },
    /// A drawing.
    #[error(transparent)]
    Chart(#[from] ChartError),
    /// A record that holds no configuration of the robot.
    #[error("the record holds no configuration of the robot: {0}")]
    Record(#[from] DynamicsFault),
}

/// Runs Experiment 1 and draws figures 4.3 to 4.10.
///
/// # Errors
/// A [`RobotFigureFailure`].
pub fn experiment_1_figures() -> Result<Vec<RobotFigure>, RobotFigureFailure> {
    let (_, run) = made("experiment-1")?;
    charts(&EXPERIMENT_1, "Experiment 1", &run, experiment_1::rows_of_figure)
}

/// Runs Experiment 2 and draws figures 4.11 to 4.19.
///
/// # Errors
/// A [`RobotFigureFailure`].
pub fn experiment_2_figures() -> Result<Vec<RobotFigure>, RobotFigureFailure> {
    let (scene, run) = made("experiment-2")?;
    let (picture, names) = (EXPERIMENT_2[0], &EXPERIMENT_2[1..]);
    let mut figures = charts(names, "Experiment 2", &run, experiment_2::rows_of_figure)?;
    let svg = still(&RobotRecord::new(&scene, &run.samples), PICTURE_TIME)?;
    figures.insert(0, RobotFigure { name: picture, svg, rows: experiment_2::experiment_2(&run) });
    Ok(figures)
}

fn made(name: &str) -> Result<(surefoot_sim::scene::Scene, Run), RobotFigureFailure> {
    let mut scene = load(name)?;
    scene.controller.torques_from = TorquesFrom::TouchDown;
    let run = run(&scene, controller(&scene, Scalar::F64).as_mut(), &mut |_| {});
    match run.failure {
        None => Ok((scene, run)),
        Some(failure) => Err(RobotFigureFailure::Run {
            scene: scene.name,
            time_s: failure.time_s,
            reason: failure.place,
        }),
    }
}

/// The number of a scene's figure by its place among [`RUN_FIGURES`], if the text has that figure.
pub fn number(scene: &str, place: usize) -> Option<&'static str> {
    let names = match scene {
        "experiment-1" => &EXPERIMENT_1[..],
        "experiment-2" => &EXPERIMENT_2[1..],
        _ => return None,
    };
    Some(names.get(place)?.trim_start_matches("figure-"))
}

/// The eight charts under their numbers.
fn charts(
    names: &[&'static str],
    of: &str,
    run: &Run,
    rows: fn(usize, &Run) -> Vec<Comparison>,
) -> Result<Vec<RobotFigure>, RobotFigureFailure> {
    let numbered = names.iter().zip(&RUN_FIGURES).enumerate();
    numbered
        .map(|(i, (name, figure))| {
            let number = name.trim_start_matches("figure-");
            let title = format!("Figure {number}, {of}");
            let svg = figure.svg(&title, &biped(Outline::A), &run.samples, &run.events)?;
            Ok(RobotFigure { name, svg, rows: rows(i, run) })
        })
        .collect()
}

//! `surefoot run`

use super::controller::{ControllerOptions, Place};
use super::model::ModelName;
use super::report::{self, Report};
use super::run_mechanism::run_mechanism;
use super::{RUN_FAILED, bad_input, recommended, say};
use crate::chart::RUN_FIGURES;
use crate::closed_loop::{self, Run};
use crate::integrators::Method;
use crate::picture::Shown;
use crate::record::{SavedRun, write_csv, write_mcap};
use crate::report::page;
use crate::scene::{AnyScene, Feet, Scene, TorquesFrom, open};
use clap::Parser;
use indicatif::{ProgressBar, ProgressStyle};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Options of `run`.
#[derive(Debug, Parser)]
pub struct Options {
    /// A built-in scene (see `surefoot list`) or a TOML file
    #[arg(default_value = "experiment-1")]
    scene: String,
    /// Method, instead of the scene's
    #[arg(long, value_enum)]
    pub(super) integrator: Option<Method>,
    /// Step in seconds, instead of the scene's
    #[arg(long, allow_negative_numbers = true)]
    pub(super) step: Option<f64>,
    /// Take the quickest method and step whose error is at most this, over how far the motion reaches (see `surefoot
    /// advise`)
    #[arg(long)]
    pub(super) accuracy: Option<f64>,
    /// Simulated seconds, instead of the scene's
    #[arg(long, allow_negative_numbers = true)]
    pub(super) duration: Option<f64>,
    #[command(flatten)]
    controller: ControllerOptions,
    /// Links of a pendulum, instead of the scene's
    #[arg(long)]
    pub(super) links: Option<usize>,
    /// When torques set in, instead of the scene's
    #[arg(long, value_enum)]
    torques_from: Option<TorquesFrom>,
    /// How much is modelled, instead of what the scene says or bears
    #[arg(long, value_enum)]
    pub(super) model: Option<ModelName>,
    /// Where the record and the charts go (default: out/SCENE)
    #[arg(long)]
    out: Option<PathBuf>,
    /// Where to write the state at the end, to go on from
    #[arg(long, value_name = "FILE")]
    pub(super) save: Option<PathBuf>,
    /// A file of `--save`: the run goes on from there, to the same bits as if it had not stopped
    #[arg(long, value_name = "FILE")]
    resume: Option<PathBuf>,
    /// One JSON document on stdout instead of the summary
    #[arg(long)]
    pub(super) json: bool,
}

impl Options {
    pub(super) fn folder(&self, scene: &str) -> PathBuf {
        self.out.clone().unwrap_or_else(|| Path::new("out").join(scene))
    }

    /// The run to go on from, if one was named.
    pub(super) fn saved(&self, scene: &str) -> Result<Option<SavedRun>, String> {
        let read = |path: &PathBuf| SavedRun::read(path)?.of_scene(scene);
        self.resume.as_ref().map(read).transpose()
    }

    /// Writes where a run stopped, if that was asked for.
    pub(super) fn write_saved(&self, saved: Option<&SavedRun>) -> Result<(), String> {
        match (&self.save, saved) {
            (None, _) => Ok(()),
            (Some(path), Some(saved)) => saved.write(path),
            (Some(_), None) => Err("--save: only runs of bodies and joints under the method \
                                    variational, which have not failed, can be saved"
                .to_owned()),
        }
    }

    /// Whether something was said that a scene without a controller has no use for.
    pub(super) fn is_about_a_controller(&self) -> bool {
        self.torques_from.is_some() || self.controller.was_chosen()
    }
}

/// Runs the scene and reports.
pub fn run(options: &Options) -> ExitCode {
    let scene = match open(&options.scene) {
        Ok(AnyScene::Robot(scene)) => *scene,
        Ok(AnyScene::Mechanism(scene)) => return run_mechanism(scene, options),
        Err(error) => return bad_input(&error.to_string(), options.json),
    };
    let (scene, reason) = match with_options(scene, options) {
        Ok(chosen) => chosen,
        Err(message) => return bad_input(&message, options.json),
    };
    let run = match simulate(&scene, options) {
        Ok(run) => run,
        Err(message) => return bad_input(&message, options.json),
    };
    // A run that goes on has no first instant.
    let other = match other_reading(&scene)
        .filter(|_| options.resume.is_none())
        .map(|scene| simulate(&scene, options).map(|run| (scene.controller.torques_from, run)))
    {
        None => None,
        Some(Ok(other)) => Some(other),
        Some(Err(message)) => return bad_input(&message, options.json),
    };

    if let Err(message) = options.write_saved(run.saved.as_ref()) {
        return bad_input(&message, options.json);
    }
    let report = Report {
        scene: &scene,
        reason: &reason,
        scalar: options.controller.scalar(),
        controller: options.controller.place,
        run: &run,
        other: other.as_ref(),
    };
    let files = match write_files(&options.folder(&scene.name), &report) {
        Ok(files) => files,
        Err(message) => return bad_input(&message, options.json),
    };
    if options.json {
        say(&format!("{:#}\n", report::json(&report, &files)));
    } else {
        say(&report::text(&report, &files));
    }
    match &run.failure {
        None => ExitCode::SUCCESS,
        Some(failure) => {
            eprintln!("failed at {:.4} s: {}", failure.time_s, failure.place);
            ExitCode::from(RUN_FAILED)
        }
    }
}

fn with_options(mut scene: Scene, options: &Options) -> Result<(Scene, String), String> {
    if options.links.is_some() {
        return Err(format!("{} has no links to choose a number of", scene.name));
    }
    if let Some(duration) = options.duration {
        scene.duration_s = duration;
    }
    if let Some(from) = options.torques_from {
        scene.controller.torques_from = from;
    }
    if let Some(model) = options.model {
        scene.model = model.of_robot()?;
    }
    let reason = recommended::of_robot(&mut scene, options)?;
    scene.check().map_err(|error| error.to_string())?;
    Ok((scene, reason))
}

/// The same scene in the other reading of the first instant; welded feet have only one.
fn other_reading(scene: &Scene) -> Option<Scene> {
    if !matches!(scene.feet, Feet::Floor { .. }) {
        return None;
    }
    let mut other = scene.clone();
    other.controller.torques_from = match scene.controller.torques_from {
        TorquesFrom::Start => TorquesFrom::TouchDown,
        TorquesFrom::TouchDown => TorquesFrom::Start,
    };
    Some(other)
}

/// Runs with a progress bar on stderr, which hides itself where that is no terminal.
fn simulate(scene: &Scene, options: &Options) -> Result<Run, String> {
    let mut controller = options.controller.controller(scene).map_err(|error| error.to_string())?;
    let from = options.saved(&scene.name)?;
    let bar = bar(&scene.name, scene.duration_s);
    let mut run = closed_loop::run_from(scene, controller.as_mut(), from.as_ref(), &mut |time| {
        bar.set_position((time * 1e3) as u64);
    });
    // A run that goes on, and a controller that runs elsewhere, cannot be played again from the start.
    if from.is_none() && options.controller.place == Place::Host {
        closed_loop::explain(scene, &mut run, &mut |scene| {
            let mut controller = options.controller.controller(scene).ok()?;
            Some(closed_loop::run(scene, controller.as_mut(), &mut |_| {}))
        });
    }
    bar.finish_and_clear();
    Ok(run)
}

/// A progress bar over simulated time.
pub(super) fn bar(scene: &str, duration_s: f64) -> ProgressBar {
    let bar = ProgressBar::new((duration_s * 1e3) as u64);
    // The template is constant and valid; were it not, the default style would do.
    if let Ok(style) = ProgressStyle::with_template("{msg} {wide_bar} {pos}/{len} ms {eta}") {
        bar.set_style(style);
    }
    bar.set_message(scene.to_owned());
    bar
}

/// The record's file in a folder that is made.
pub(super) fn created(folder: &Path) -> Result<(PathBuf, std::fs::File), String> {
    let context = |error: &dyn std::fmt::Display| format!("{}: {error}", folder.display());
    std::fs::create_dir_all(folder).map_err(|error| context(&error))?;
    let record = folder.join("record.csv");
    let file = std::fs::File::create(&record).map_err(|error| context(&error))?;
    Ok((record, file))
}

/// The report, the record in both forms, and the figures.
fn write_files(folder: &Path, report: &Report<'_>) -> Result<Vec<PathBuf>, String> {
    let Report { scene, run, .. } = report;
    let (record, file) = created(folder)?;
    write_csv(&run.samples, std::io::BufWriter::new(file))
        .map_err(|error| format!("{}: {error}", record.display()))?;
    let mcap = folder.join("record.mcap");
    let in_mcap = |error: &dyn std::fmt::Display| format!("{}: {error}", mcap.display());
    let file = std::fs::File::create(&mcap).map_err(|error| in_mcap(&error))?;
    let to = std::io::BufWriter::new(file);
    write_mcap(&Shown::of(scene), &run.samples, &run.events, to)
        .map_err(|error| in_mcap(&error))?;
    let html = page(&report.page()).map_err(|error| error.to_string())?;
    let mut files = vec![written(folder.join("report.html"), &html)?, record, mcap];
    for figure in RUN_FIGURES {
        let svg = figure.svg(&scene.name, &run.samples, &run.events);
        let svg = svg.map_err(|error| error.to_string())?;
        files.push(written(folder.join(format!("{}.svg", figure.name)), &svg)?);
    }
    Ok(files)
}

fn written(path: PathBuf, text: &str) -> Result<PathBuf, String> {
    std::fs::write(&path, text).map_err(|error| format!("{}: {error}", path.display()))?;
    Ok(path)
}

//! `surefoot run`

use super::controller::{ControllerOptions, Place};
use super::files::{keeps_record, made, write_run};
use super::interrupt::{self, INTERRUPTED};
use super::model::ModelName;
use super::report::{self, Report};
use super::run_mechanism::run_mechanism;
use super::{RUN_FAILED, bad_input, complain, recommended, say};
use crate::chart::{RUN_FIGURES, RunFigure};
use crate::report::page;
use clap::Parser;
use indicatif::{ProgressBar, ProgressStyle};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use surefoot_mechanics::integrators::Method;
use surefoot_sim::closed_loop::{self, Run};
use surefoot_sim::follow::Until;
use surefoot_sim::picture::moving;
use surefoot_sim::record::{MotionIdentity, RobotRecord, SavedRun};
use surefoot_sim::scene::{AnyScene, Feet, Scene, StateSource, TorquesFrom, open};

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
    /// Where the record and the charts go (default: out/SCENE, or out/SCENE-from-TIME-s with --resume)
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
    /// Where the files go: what a run leaves that goes on from another one stands beside what that one left.
    pub(super) fn folder(&self, scene: &str, from: Option<&SavedRun>) -> PathBuf {
        self.out.clone().unwrap_or_else(|| {
            let out = Path::new("out");
            match from {
                None => out.join(scene),
                Some(saved) => out.join(format!("{scene}-from-{}-s", saved.time_s)),
            }
        })
    }

    /// The run to go on from, if one was named; not one that has been where this one ends.
    pub(super) fn saved(&self, duration_s: f64) -> Result<Option<SavedRun>, String> {
        let Some(path) = &self.resume else { return Ok(None) };
        let saved = SavedRun::read(path)?;
        if saved.time_s >= duration_s {
            return Err(format!(
                "--resume {}: it has reached {} s, and this run would end at {duration_s} s: --duration must be longer",
                path.display(),
                saved.time_s,
            ));
        }
        Ok(Some(saved))
    }

    /// Refuses `--save` of what cannot be taken up again.
    pub(super) fn check_save(&self, can_be_saved: bool) -> Result<(), String> {
        if self.save.is_none() || can_be_saved {
            return Ok(());
        }
        let what =
            "--save: only runs of bodies and joints under the method variational can be saved";
        Err(what.to_owned())
    }

    /// The option that wants a run to be taken up again.
    fn keeps(&self) -> Option<&'static str> {
        let resumes = self.resume.as_ref().map(|_| "--resume");
        self.save.as_ref().map(|_| "--save").or(resumes)
    }

    /// Writes where a run stopped, if that is wanted; a run that failed has no such place.
    pub(super) fn write_saved(&self, saved: Option<&SavedRun>) -> Result<(), String> {
        match (&self.save, saved) {
            (None, _) => Ok(()),
            (Some(path), Some(saved)) => saved.write(path),
            (Some(path), None) => {
                complain(format_args!("not saved to {}: the run has failed", path.display()));
                Ok(())
            }
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
    match run_robot(scene, options) {
        Ok(status) => status,
        Err(message) => bad_input(&message, options.json),
    }
}

fn run_robot(scene: Scene, options: &Options) -> Result<ExitCode, String> {
    options.controller.check()?;
    let (scene, reason) = with_options(scene, options)?;
    options.controller.serves(&scene)?;
    let scalar = options.controller.scalar();
    let saved = options.saved(scene.duration_s)?;
    if let Some(saved) = &saved {
        belongs(saved, &scene, &options.controller)?;
    }
    let folder = options.folder(&scene.name, saved.as_ref());
    keeps_record(&folder, saved.as_ref())?;
    if scene.sensing.state == StateSource::Estimate
        && let Some(option) = options.keeps()
    {
        return Err(format!(
            "{option}: a run whose state is estimated (`sensing.state`) cannot be taken up again"
        ));
    }
    options.check_save(scene.integrator.name == Method::Variational)?;
    if !scene.walk.is_empty() {
        walks_here(options)?;
    }
    let warnings = scene.warnings();
    warn(&warnings);
    // Not after the run, which would be lost.
    made(&folder)?;
    let mut run = simulate(&scene, options, saved.as_ref())?;
    if let Some(saved) = &mut run.saved {
        saved.scalar = Some(scalar);
    }
    // A run that goes on has no first instant.
    let mut is_interrupted = run.is_interrupted;
    let other = match other_reading(&scene).filter(|_| saved.is_none() && !is_interrupted) {
        None => None,
        Some(scene) => {
            let other = simulate(&scene, options, None)?;
            is_interrupted = other.is_interrupted;
            (!is_interrupted).then_some((scene.controller.torques_from, other))
        }
    };
    let report = Report {
        scene: &scene,
        reason: &reason,
        warnings: &warnings,
        scalar,
        controller: options.controller.place,
        run: &run,
        other: other.as_ref(),
    };
    let files = write_files(&folder, &report)?;
    options.write_saved(run.saved.as_ref())?;
    let failed = run.failure.as_ref().map(|f| format!("failed at {:.4} s: {}", f.time_s, f.place));
    let reached = run.samples.last().map_or(0.0, |last| last.time_s);
    let status = ended(failed, is_interrupted.then_some(reached));
    if options.json {
        return Ok(say(&format!("{:#}\n", report::json(&report, &files)), status));
    }
    Ok(say(&report::text(&report, &files), status))
}

/// Refuses what a walk cannot be asked for yet.
fn walks_here(options: &Options) -> Result<(), String> {
    if options.save.is_some() {
        return Err("--save: what a walk remembers is not saved".into());
    }
    Ok(())
}

/// Refuses a saved run of another motion.
fn belongs(saved: &SavedRun, scene: &Scene, options: &ControllerOptions) -> Result<(), String> {
    let scalar = options.scalar();
    let other = saved.motion.difference(&MotionIdentity::of_robot(scene));
    let other = other.or_else(|| {
        let of_saved = saved.scalar.filter(|of_saved| *of_saved != scalar)?;
        Some(format!("--scalar {of_saved:?}, not {scalar:?}").to_lowercase())
    });
    // A supervisor on the target keeps what it remembers to itself.
    let other = other.or_else(|| match (&saved.supervisor, options.place) {
        (Some(_), Place::Bare) => {
            Some("its controller had a supervisor, --controller bare has none".into())
        }
        (None, Place::Host) => {
            Some("its controller had no supervisor here, --controller host has one".into())
        }
        _ => None,
    });
    match other {
        None => Ok(()),
        Some(difference) => Err(format!("the saved run is of another motion: {difference}")),
    }
}

/// Says of a run that has not come to its end why, on stderr, and gives its exit status.
pub(super) fn ended(failed: Option<String>, interrupted_s: Option<f64>) -> ExitCode {
    if let Some(failure) = failed {
        complain(failure);
        return ExitCode::from(RUN_FAILED);
    }
    if let Some(time_s) = interrupted_s {
        complain(format_args!("interrupted at {time_s:.4} s"));
        return ExitCode::from(INTERRUPTED);
    }
    ExitCode::SUCCESS
}

/// What the user should know before the run begins.
pub(super) fn warn(warnings: &[String]) {
    for warning in warnings {
        complain(format_args!("warning: {warning}"));
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

/// The same scene in the other reading of the first instant; welded feet, and robots that walk, have only one.
fn other_reading(scene: &Scene) -> Option<Scene> {
    if !matches!(scene.feet, Feet::Floor { .. }) || !scene.walk.is_empty() {
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
fn simulate(scene: &Scene, options: &Options, from: Option<&SavedRun>) -> Result<Run, String> {
    let mut controller = options.controller.controller(scene).map_err(|error| error.to_string())?;
    let bar = bar(&scene.name, scene.duration_s);
    let follower = |time: f64| bar.set_position((time * 1e3) as u64);
    let mut follow = Until { stop: interrupt::watched(), follower };
    let mut run = closed_loop::run_from(scene, controller.as_mut(), from, &mut follow);
    // A run that goes on, and a controller that runs elsewhere, cannot be played again from the start.
    if from.is_none() && options.controller.place != Place::Firmware {
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

/// The report, the record in both forms, and the figures.
fn write_files(folder: &Path, report: &Report<'_>) -> Result<Vec<PathBuf>, String> {
    let Report { scene, run, .. } = report;
    let (record, robot) = (RobotRecord::new(scene, &run.samples), scene.robot());
    let drawn = |figure: &RunFigure| {
        let svg = figure.svg(&scene.name, &robot, &run.samples, &run.events);
        svg.map(|svg| (figure.name, svg)).map_err(|error| error.to_string())
    };
    write_run(
        folder,
        &record,
        &run.events,
        || page(&report.page()).map_err(|error| error.to_string()),
        || {
            let mut figures = RUN_FIGURES.iter().map(drawn).collect::<Result<Vec<_>, String>>()?;
            if let Some(gait) = run.gait.as_ref().filter(|gait| gait.falls == 0) {
                // Two seconds of the walk at its full speed.
                let picture = moving(&record, [gait.ended_s - 2.0, gait.ended_s]);
                figures.push(("moving", picture.map_err(|error| error.to_string())?));
            }
            Ok(figures)
        },
    )
}

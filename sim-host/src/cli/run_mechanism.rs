//! `surefoot run` of a mechanism that nobody controls.

use super::files::{keeps_record, made, write_run};
use super::model::ModelName;
use super::report::{SHOWN_EVENTS, other_end};
use super::run::{Options, bar, ended, warn};
use super::{bad_input, interrupt, recommended, say};
use crate::chart::{MECHANISM_FIGURES, MechanismFigure};
use crate::report::{MechanismReport, mechanism_page};
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use surefoot_mechanics::forecast::FailureKind;
use surefoot_mechanics::integrators::Method;
use surefoot_sim::follow::Until;
use surefoot_sim::mechanism::{Cause, ChosenModel, MechanismRun, run_model};
use surefoot_sim::record::MechanismRecord;
use surefoot_sim::scene::{Mechanism, MechanismScene};

/// Runs the scene and reports.
pub(super) fn run_mechanism(scene: MechanismScene, options: &Options) -> ExitCode {
    match run_to_its_end(scene, options) {
        Ok(status) => status,
        Err(message) => bad_input(&message, options.json),
    }
}

fn run_to_its_end(scene: MechanismScene, options: &Options) -> Result<ExitCode, String> {
    let (scene, reason) = with_options(scene, options)?;
    let saved = options.saved(scene.duration_s)?;
    let folder = options.folder(&scene.name, saved.as_ref());
    keeps_record(&folder, saved.as_ref())?;
    let wanted = options.model.map_or(Ok(None), ModelName::of_mechanism)?;
    let of_bodies =
        !matches!(scene.mechanism, Mechanism::RigidBody { .. } | Mechanism::Pendulum { .. });
    options.check_save(of_bodies && scene.integrator.name == Method::Variational)?;
    let warnings = scene.warnings();
    warn(&warnings);
    // Not after the run, which would be lost.
    made(&folder)?;
    let bar = bar(&scene.name, scene.duration_s);
    let follower = |time: f64| bar.set_position((time * 1e3) as u64);
    let mut follow = Until { stop: interrupt::watched(), follower };
    let run = run_model(&scene, wanted, saved.as_ref(), &mut follow);
    bar.finish_and_clear();
    let run = run.map_err(|error| format!("{}: {error}", scene.name))?;
    let files = write_files(&folder, (&scene, &reason, &warnings), &run)?;
    options.write_saved(run.saved.as_ref())?;
    let failed = run.failure.as_ref().map(|f| format!("failed at {:.4} s: {f}", f.time_s));
    let status = ended(failed, run.is_interrupted.then_some(run.progress.time_s));
    if options.json {
        let document = document(&scene, &reason, &warnings, &run, &files);
        return Ok(say(&format!("{document:#}\n"), status));
    }
    Ok(say(&text(&scene, &reason, &warnings, &run, &files), status))
}

fn with_options(
    scene: MechanismScene,
    options: &Options,
) -> Result<(MechanismScene, String), String> {
    if options.is_about_a_controller() {
        return Err(format!("{} has no controller, and no options of one", scene.name));
    }
    let mut scene = match options.links {
        None => scene,
        Some(links) => scene.with_links(links).map_err(|error| error.to_string())?,
    };
    if let Some(duration) = options.duration {
        scene.duration_s = duration;
    }
    let reason = recommended::of_mechanism(&mut scene, options)?;
    scene.check().map_err(|error| error.to_string())?;
    Ok((scene, reason))
}

fn write_files(
    folder: &Path,
    (scene, reason, warnings): (&MechanismScene, &str, &[String]),
    run: &MechanismRun,
) -> Result<Vec<PathBuf>, String> {
    let record = MechanismRecord::new(&scene.mechanism, &run.samples)
        .map_err(|error| format!("{}: {error}", scene.name))?;
    let advice = advice(run);
    let report = MechanismReport { scene, reason, warnings, run, record: &record, advice: &advice };
    let drawn = |figure: &MechanismFigure| {
        let svg = figure.svg(&scene.name, &record, &run.events);
        let named = svg.map(|svg| svg.map(|svg| (figure.name, svg)));
        named.map_err(|error| error.to_string()).transpose()
    };
    write_run(
        folder,
        &record,
        &run.events,
        || mechanism_page(&report).map_err(|error| error.to_string()),
        || MECHANISM_FIGURES.iter().filter_map(drawn).collect(),
    )
}

/// What to try after a failure: no step, and no method, that has not been tried.
fn advice(run: &MechanismRun) -> String {
    match run.cause {
        Some(Cause::StepTooLong { step_s }) => {
            format!("a shorter step: with {step_s:.3e} s the run completes (tried)")
        }
        Some(Cause::StepTooLongHere { step_s, from_s }) => format!(
            "a shorter step: {step_s:.3e} s gets past this instant (tried from {from_s:.4} s on)"
        ),
        Some(Cause::NotTheStep { down_to_s, method: None }) => format!(
            "not a shorter step: {down_to_s:.1e} s fails at the same instant (tried); look at the record there"
        ),
        Some(Cause::NotTheStep { down_to_s, method: Some(method) }) => format!(
            "not a shorter step: {down_to_s:.1e} s fails at the same instant; --integrator {method} completes the \
             run and keeps its energy (both tried)"
        ),
        Some(Cause::ShorterFailToo { down_to_s }) => format!(
            "none is known: steps down to {down_to_s:.1e} s fail as well, at other times (tried)"
        ),
        Some(Cause::NoStepHelps) => "joints without this lock: no step gets past it".to_owned(),
        Some(Cause::NotTried) | None => {
            "perhaps a shorter step: none has been tried, as that would take too long".to_owned()
        }
    }
}

/// The longest step that is known to work: the one that was tried after a failure, or else what is predicted.
fn step_that_works(run: &MechanismRun) -> Option<f64> {
    match run.failure {
        Some(_) => run.cause.and_then(|cause| cause.step_s()),
        None => run.forecast_s,
    }
}

fn outcome(run: &MechanismRun) -> &'static str {
    match &run.failure {
        Some(_) => "failed",
        None if run.is_interrupted => "interrupted",
        None => "completed",
    }
}

/// The time of the record's last row, s.
fn reached(run: &MechanismRun) -> f64 {
    run.samples.last().map_or(0.0, |last| last.time_s)
}

fn text(
    scene: &MechanismScene,
    reason: &str,
    warnings: &[String],
    run: &MechanismRun,
    files: &[PathBuf],
) -> String {
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = lines(&mut out, scene, reason, run);
    for warning in warnings {
        let _ = writeln!(out, "  warning: {warning}");
    }
    for file in files {
        let _ = writeln!(out, "  {}", file.display());
    }
    out
}

fn lines(
    out: &mut String,
    scene: &MechanismScene,
    reason: &str,
    run: &MechanismRun,
) -> std::fmt::Result {
    writeln!(out, "{}: {}", scene.name, outcome(run).to_uppercase())?;
    writeln!(out, "  {}", scene.description)?;
    if let Some(failure) = &run.failure {
        writeln!(out, "  {failure}")?;
        writeln!(out, "  advice: {}", advice(run))?;
    }
    if let Some(line) = other_end(scene.duration_s, reached(run), scene.integrator.step_s, "steps")
    {
        writeln!(out, "  {line}")?;
    }
    if let Some(ChosenModel { model, bodies, reason }) = &run.model {
        writeln!(out, "  model: {model}, bodies: {bodies}; {reason}")?;
    }
    let steps = run.progress.steps;
    let wall_s = run.wall.as_secs_f64();
    writeln!(
        out,
        "  {}: {steps} steps of {} s in {wall_s:.2} s ({:.1} µs a step)",
        scene.integrator.name,
        scene.integrator.step_s,
        wall_s * 1e6 / steps.max(1) as f64,
    )?;
    writeln!(out, "  method and step: {reason}")?;
    writeln!(
        out,
        "  Newton iterations: {:.2} on average, {} at most; unknowns: {}",
        run.progress.mean_iterations(),
        run.progress.most_iterations,
        run.unknowns,
    )?;
    if run.progress.split_steps > 0 {
        writeln!(out, "  steps made in shorter ones: {}", run.progress.split_steps)?;
    }
    for event in run.events.iter().take(SHOWN_EVENTS) {
        writeln!(out, "  {:7.4} s  {} {}", event.time_s, event.place, event.kind)?;
    }
    if run.events.len() > SHOWN_EVENTS {
        writeln!(out, "  and {} more events (--json lists all)", run.events.len() - SHOWN_EVENTS)?;
    }
    if let (None, Some(step)) = (run.failure, run.forecast_s) {
        writeln!(out, "  longest step predicted: {step:.2e} s")?;
    }
    if let Some(first) = run.samples.first() {
        let [low, high] = run.energy_range;
        write!(out, "  energy: {:.6} J, band {:.1e} J", first.energy, high - low)?;
        if let Some(slope) = run.energy_slope() {
            write!(out, ", slope {slope:.1e} J/s")?;
        }
        writeln!(out)?;
        if run.has_lost_energy() {
            let share = (high - low) / run.kinetic_max;
            writeln!(
                out,
                "  WARNING: nothing here takes or gives energy, and it changes by {share:.1} of the largest kinetic \
                 energy: this is another motion"
            )?;
        }
    }
    if let Some(drift) = run.momentum_drift() {
        writeln!(out, "  angular momentum: changes by {drift:.1e} of itself")?;
    }
    writeln!(out, "  constraints: {:.1e} at most", run.constraint_max)
}

/// The document of `--json`. Keys that have no meaning for a mechanism are null.
fn document(
    scene: &MechanismScene,
    reason: &str,
    warnings: &[String],
    run: &MechanismRun,
    files: &[PathBuf],
) -> Value {
    let failure = run.failure.as_ref().map(|failure| {
        json!({
            "kind": FailureKind::from(*failure),
            "time_s": failure.time_s,
            "where": failure.to_string(),
            "advice": advice(run),
            "cause": run.cause,
        })
    });
    let [low, high] = run.energy_range;
    json!({
        "scene": scene.name,
        "integrator": scene.integrator.name,
        "step_s": scene.integrator.step_s,
        "integrator_reason": reason,
        "duration_s": reached(run),
        "requested_duration_s": scene.duration_s,
        "warnings": warnings,
        "scalar": "f64",
        "model": run.model,
        "steps": run.progress.steps,
        "outcome": outcome(run),
        "failure": failure,
        "wall_s": run.wall.as_secs_f64(),
        "wall_us_per_step": run.wall.as_secs_f64() * 1e6 / run.progress.steps.max(1) as f64,
        "newton": {
            "mean": run.progress.mean_iterations(),
            "max": run.progress.most_iterations,
            "split_steps": run.progress.split_steps,
        },
        "unknowns_per_step": run.unknowns,
        "forecast_step_s": step_that_works(run),
        "energy": {
            "initial_j": run.samples.first().map(|sample| sample.energy),
            "band_j": (high >= low).then_some(high - low),
            "slope_j_per_s": run.energy_slope(),
            "is_lost": run.has_lost_energy(),
        },
        "momentum": { "linear_drift": Value::Null, "angular_drift": run.momentum_drift() },
        "constraint_max": run.constraint_max,
        "peak_torque_nm": Value::Null,
        "desired_force_z_n": Value::Null,
        "final": run.samples.last().map(|sample| {
            json!({ "configuration": sample.configuration, "velocity": sample.velocity })
        }),
        "events": run.events,
        "files": files,
    })
}

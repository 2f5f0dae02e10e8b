//! The page of a mechanism's run.

use super::page::{Content, FailureText, PageFailure, Sheet, Word, drawn};
use super::tables::{self, Fact, with_minus};
use crate::chart::{ChartError, MECHANISM_FIGURES};
use surefoot_sim::mechanism::{ChosenModel, LayoutKind, MechanismRun};
use surefoot_sim::record::{MechanismRecord, Record};
use surefoot_sim::scene::{Mechanism, MechanismScene};

/// All that a page is made from.
#[derive(Clone, Copy)]
pub struct MechanismReport<'a> {
    /// The scene as run.
    pub scene: &'a MechanismScene,
    /// Why it has this method and this step.
    pub reason: &'a str,
    /// What the user should know of the scene.
    pub warnings: &'a [String],
    /// The run.
    pub run: &'a MechanismRun,
    /// What its samples are, by name.
    pub record: &'a MechanismRecord<'a>,
    /// What to try after a failure.
    pub advice: &'a str,
}

/// Draws the page.
///
/// # Errors
/// A [`PageFailure`].
pub fn mechanism_page(report: &MechanismReport<'_>) -> Result<String, PageFailure> {
    let MechanismReport { scene, run, record, .. } = report;
    let content = Content {
        scene: &scene.name,
        description: &scene.description,
        outcome: word(run),
        failure: run.failure.as_ref().map(|failure| FailureText {
            time: format!("{:.4}", failure.time_s),
            place: failure.to_string(),
            advice: report.advice.to_owned(),
        }),
        warnings: report.warnings,
        facts: facts(report),
        sheet: Sheet {
            title: "What is kept",
            head: ["", "at the start", "changes by"],
            rows: kept(run),
        },
        readings: Vec::new(),
        printed: Vec::new(),
        places: tables::places(&run.events),
        figures: figures(report)?,
        figures_note: if run.events.is_empty() {
            ""
        } else {
            "Vertical lines mark points that touch down on the floor, or lift off."
        },
        note: note(report),
        has_controller: false,
    };
    drawn(&content, *record, &run.events)
}

fn figures(report: &MechanismReport<'_>) -> Result<Vec<String>, ChartError> {
    let MechanismReport { scene, run, record, .. } = report;
    let drawn = MECHANISM_FIGURES.iter().map(|figure| figure.svg(&scene.name, record, &run.events));
    drawn.filter_map(Result::transpose).collect()
}

fn word(run: &MechanismRun) -> Word {
    let (word, class) = match &run.failure {
        Some(_) => ("Failed", "failed"),
        None if run.is_interrupted => ("Interrupted", "completed"),
        None => ("Completed", "balanced"),
    };
    Word { word, class }
}

fn facts(report: &MechanismReport<'_>) -> Vec<Fact> {
    let MechanismReport { scene, reason, run, .. } = report;
    let mut facts = Vec::new();
    let mut add = |name, value: String| facts.push(Fact { name, value });
    let reached = run.samples.last().map_or(0.0, |last| last.time_s);
    let whole = (reached - scene.duration_s).abs() <= 1e-9 * scene.duration_s;
    let wanted = if whole { String::new() } else { format!(" of {} s", scene.duration_s) };
    add("simulated", format!("{} s{wanted}", rounded(reached)));
    let (method, step) = (scene.integrator.name.name(), scene.integrator.step_s);
    add("method", format!("{method}, steps of {} ms", rounded(1e3 * step)));
    add("why these", (*reason).to_owned());
    if let Some(ChosenModel { model, bodies, reason }) = &run.model {
        add("model", format!("{model}, bodies: {bodies}; {reason}"));
    }
    add("unknowns a step", run.unknowns.to_string());
    let (mean, most) = (run.progress.mean_iterations(), run.progress.most_iterations);
    if most > 0 {
        add("Newton iterations", format!("{mean:.2} on average, {most} at most"));
    }
    if run.progress.split_steps > 0 {
        add("steps made in shorter ones", run.progress.split_steps.to_string());
    }
    let (steps, seconds) = (run.progress.steps, run.wall.as_secs_f64());
    let per_step = 1e6 * seconds / steps.max(1) as f64;
    add("cost", format!("{steps} steps in {seconds:.2} s: {per_step:.1} µs a step"));
    if let (None, Some(step)) = (run.failure, run.forecast_s) {
        add("longest step predicted", format!("{} ms", rounded(1e3 * step)));
    }
    if run.has_lost_energy() {
        let text = "nothing here takes or gives energy, and it changes: this is another motion";
        add("warning", text.to_owned());
    }
    facts
}

/// To four digits, without zeros behind the point.
fn rounded(x: f64) -> String {
    let digits = (3.0 - x.abs().log10().floor()).clamp(0.0, 12.0) as usize;
    let text = format!("{x:.digits$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

/// Energy, momentum and constraints: at the start, and by how much they change.
fn kept(run: &MechanismRun) -> Vec<[String; 3]> {
    let Some(first) = run.samples.first() else { return Vec::new() };
    let [low, high] = run.energy_range;
    let keeps = if run.keeps_energy { "" } else { " (something takes or gives some)" };
    let mut rows = vec![[
        format!("energy{keeps}"),
        with_minus(&format!("{:.6} J", first.energy)),
        with_minus(&format!("{:.1e} J", high - low)),
    ]];
    if let Some(slope) = run.energy_slope() {
        let slope = with_minus(&format!("{slope:.1e} J/s"));
        rows.push(["energy's straight line".to_owned(), String::new(), slope]);
    }
    if !first.momentum.is_empty() {
        let size = first.momentum.iter().map(|m| m * m).sum::<f64>().sqrt();
        let what = if first.momentum.len() == 1 { " about the vertical" } else { "" };
        let drift = run.momentum_drift();
        let drift = drift.map_or("–".to_owned(), |drift| format!("{drift:.1e} of itself"));
        rows.push([
            format!("angular momentum{what}"),
            format!("{size:.4} N·m·s"),
            with_minus(&drift),
        ]);
    }
    let largest = with_minus(&format!("{:.1e}", run.constraint_max));
    rows.push([
        "errors of joints (m or rad)".to_owned(),
        "0".to_owned(),
        format!("{largest} at most"),
    ]);
    rows
}

/// What arrows, squares and solids mean.
fn note(report: &MechanismReport<'_>) -> String {
    let MechanismReport { scene, record, .. } = report;
    let shown = record.shown();
    let (framing, layout) = (shown.framing, record.layout());
    let squares = length(framing.square);
    let ground = if layout.points.is_empty() {
        format!("Squares of {squares}, which are no floor.")
    } else {
        format!("Floor in squares of {squares}.")
    };
    let arrows = if shown.force_length > 0.0 {
        // As long as a square.
        let newtons = rounded(framing.square / shown.force_length);
        format!(" Arrows: {squares} for {newtons} N.")
    } else {
        String::new()
    };
    let bodies = match (&scene.mechanism, &layout.kind) {
        (Mechanism::RigidBody { .. }, _) => {
            "The body is a box of uniform density with its proportions of inertia, the longest edge 1 m: its mass and \
             size are of no account."
        }
        (Mechanism::Chain { .. }, _) => "Rods have the length and thickness of the scene.",
        (_, LayoutKind::Rods(_)) => "Point masses on rods without mass.",
        _ => {
            "Bodies are boxes of uniform density with the bodies' masses and inertias, and rods from the centre of mass \
             to the joints and what touches the floor; where such a box would hide the joints, a cube marks the centre of mass."
        }
    };
    format!("{ground}{arrows} {bodies}")
}

fn length(metres: f64) -> String {
    if metres < 1.0 {
        format!("{} cm", rounded(1e2 * metres))
    } else {
        format!("{} m", rounded(metres))
    }
}

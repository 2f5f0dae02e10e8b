//! A row of the table.

use super::peers;
use super::play::{Played, play};
use super::problems::{Benchmark, scene};
use super::references::{Reference, references};
use crate::precision::{Among, Effort as AdviceEffort, Problem, advise};
use serde::Serialize;
use std::collections::BTreeMap;
use surefoot_sim::scene::{AnyScene, MechanismScene};

/// What one program made of one problem.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// The problem.
    pub name: &'static str,
    /// The benchmark's step, s; none where no scene can say it.
    pub step_s: Option<f64>,
    /// The method at that step.
    pub method: Option<String>,
    /// What the error is.
    pub measure: &'static str,
    /// By that measure, the largest at all times of the reference; none of a run that did not end.
    pub error: Option<f64>,
    /// What is good enough.
    pub bar: f64,
    /// Whether it is.
    pub meets: bool,
    /// How the reference was found.
    pub reference: String,
    /// Why it does not meet it.
    pub reason: Option<String>,
    /// Computing time of all steps, s.
    pub wall_s: Option<f64>,
    /// The same at the method and step that `advise` names.
    pub advised: Option<Advised>,
    /// Other engines in the same run.
    pub peers: BTreeMap<&'static str, Peer>,
    /// What was played.
    #[serde(skip)]
    pub played: Option<Played>,
}

/// At the method and step that `advise` names for an error as large as the bar.
#[derive(Clone, Debug, Serialize)]
pub struct Advised {
    /// Which method.
    pub method: Option<String>,
    /// s
    pub step_s: Option<f64>,
    /// By the row's measure.
    pub error: Option<f64>,
    /// Of all steps, s.
    pub wall_s: Option<f64>,
    /// Why there is none.
    pub reason: Option<String>,
}

/// What another engine made of it.
#[derive(Clone, Debug, Serialize)]
pub struct Peer {
    /// By the row's measure.
    pub error: Option<f64>,
    /// s
    pub step_s: Option<f64>,
    /// Of all steps, s.
    pub wall_s: Option<f64>,
    /// Its method and version, or why there is no error.
    pub note: String,
}

/// What to do beside our own runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// Ask `advise`: some seconds a row.
    pub advice: bool,
    /// Ask other engines that are installed.
    pub peers: bool,
}

/// Plays problems; `progress` is told the name of each.
///
/// # Errors
/// In words, where a file as shipped cannot be read.
pub fn rows(
    of: &[&Benchmark],
    effort: Effort,
    progress: &dyn Fn(&str),
) -> Result<Vec<Row>, String> {
    let known = references().map_err(|error| format!("references.json: {error}"))?;
    let mut rows = Vec::with_capacity(of.len());
    for benchmark in of {
        progress(benchmark.name);
        rows.push(row(benchmark, known.get(benchmark.reference), effort)?);
    }
    Ok(rows)
}

fn row(of: &Benchmark, known: Option<&Reference>, effort: Effort) -> Result<Row, String> {
    let mut row = Row {
        name: of.name,
        step_s: None,
        method: None,
        measure: of.measure.words(),
        error: None,
        bar: of.bar,
        meets: false,
        reference: known.map_or("none", |known| &known.source).to_owned(),
        reason: of.scene.err().map(str::to_owned),
        wall_s: None,
        advised: None,
        peers: BTreeMap::new(),
        played: None,
    };
    let (Some(scene), Some(known)) = (scene(of), known) else { return Ok(row) };
    let scene = scene.map_err(|error| error.to_string())?;
    let played = play(&scene, of.measure, &known.times);
    row.step_s = Some(played.step_s);
    row.method = Some(scene.integrator.name.name());
    row.error = played.error;
    row.meets = played.error.is_some_and(|error| error <= of.bar);
    row.wall_s = Some(played.wall.as_secs_f64());
    row.reason = match (&played.failure, played.error) {
        (Some(failure), _) => Some(failure.clone()),
        (None, None) => Some("the reference names what the scene has not".to_owned()),
        (None, Some(_)) if row.meets => None,
        (None, Some(_)) => Some(format!("{} is not accurate enough here", scene.integrator.name)),
    };
    row.played = Some(played);
    if effort.advice {
        row.advised = Some(advised(of, &scene, known));
    }
    if effort.peers {
        row.peers = peers::all(of, &scene, known);
    }
    Ok(row)
}

fn advised(of: &Benchmark, scene: &MechanismScene, known: &Reference) -> Advised {
    let mut all = Advised { method: None, step_s: None, error: None, wall_s: None, reason: None };
    let mut scene = scene.clone();
    if let Some(last) = known.times.last() {
        scene.duration_s = last.t;
    }
    let whole = AnyScene::Mechanism(scene.clone());
    let advice = Problem::of_scene(&whole).map_err(|error| error.to_string()).and_then(|problem| {
        let accuracy = of.bar.clamp(1e-10, 1e-3);
        advise(&problem, accuracy, Among::Run, &AdviceEffort::ADVICE)
            .map_err(|error| error.to_string())
    });
    match advice.map(|advice| advice.integrator()) {
        Err(reason) => all.reason = Some(reason),
        Ok(None) => all.reason = Some("no method of `run` is advised".to_owned()),
        Ok(Some(integrator)) => {
            scene.integrator = integrator;
            let played = play(&scene, of.measure, &known.times);
            all.method = Some(integrator.name.name());
            all.step_s = Some(played.step_s);
            all.error = played.error;
            all.wall_s = Some(played.wall.as_secs_f64());
            all.reason = played.failure;
        }
    }
    all
}

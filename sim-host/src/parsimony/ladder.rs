//! All rungs of a scene's ladder, with what each costs and how far it is off.

use super::play::{PlayFailure, Played, Rung};
use super::saving::Saving;
use super::step_count::count;
use crate::callgrind::word;
use nalgebra::Vector3;
use serde::Serialize;
use std::num::NonZeroUsize;
use surefoot::spatial::Quaternion;
use surefoot_sim::scene::{self, Scene};

/// A rung's figures.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// Which one.
    pub rung: Rung,
    /// Bodies of the robot.
    pub bodies: usize,
    /// What Newton's method solves for.
    pub unknowns: Option<usize>,
    /// Instructions of a step, the mean over the motion; none without valgrind.
    pub instructions: Option<u64>,
    /// Time of a step, the mean over the motion, the least of some runs, µs.
    pub us_per_step: Option<f64>,
    /// What it is compared with.
    pub reference: Rung,
    /// How far the central body is from where the reference has it, at most, m.
    pub deviation_m: Option<f64>,
    /// How far it is turned away, at most, rad.
    pub deviation_rad: Option<f64>,
    /// Why the rung could not be played, or its instructions not be counted.
    pub failure: Option<String>,
}

/// A ladder.
#[derive(Clone, Debug, Serialize)]
pub struct Ladder {
    /// The scene's name.
    pub scene: String,
    /// What `run` plays it with, and why.
    pub chosen: scene::Rung,
    /// Every rung.
    pub rows: Vec<Row>,
    /// What lumping saves, and why no more.
    pub savings: Vec<Saving>,
}

/// Instructions are counted over this much of the motion, s: landing and the better part of the rise.
const COUNTED_S: f64 = 0.6;
/// Runs of which the quickest counts.
pub(super) const RUNS: usize = 3;

/// Plays all rungs of a scene, which can be opened by `name`; some ten to thirty seconds with valgrind.
/// `progress` is told how many rungs are done.
pub fn climb(name: &str, scene: &Scene, progress: &(dyn Fn(usize) + Sync)) -> Ladder {
    let rungs = Rung::of(scene);
    let played: Vec<_> = rungs.iter().map(|rung| quickest(*rung, scene)).collect();
    let path_of = |wanted: Rung| {
        let found = rungs.iter().zip(&played).find(|(rung, _)| **rung == wanted);
        found.and_then(|(_, played)| played.as_ref().ok()).map(|played| &played.path[..])
    };
    let counted = Scene { duration_s: scene.duration_s.min(COUNTED_S), ..scene.clone() };
    let mut rows = Vec::with_capacity(rungs.len());
    for (done, (rung, played)) in rungs.iter().zip(&played).enumerate() {
        progress(done);
        let reference = rung.reference(scene);
        let mut row = Row {
            rung: *rung,
            bodies: rung.bodies(),
            unknowns: None,
            instructions: None,
            us_per_step: None,
            reference,
            deviation_m: None,
            deviation_rad: None,
            failure: None,
        };
        match played {
            Err(failure) => row.failure = Some(failure.to_string()),
            Ok(played) => {
                row.unknowns = Some(played.unknowns);
                row.us_per_step =
                    Some(played.in_steps.as_secs_f64() * 1e6 / played.steps.max(1) as f64);
                if let Some(path) = path_of(reference) {
                    let (m, rad) = apart(path, &played.path);
                    (row.deviation_m, row.deviation_rad) = (Some(m), Some(rad));
                }
                let steps = rung.play(&counted, NonZeroUsize::MIN).map_or(0, |short| short.steps);
                match count(name, counted.duration_s, &word(*rung), steps) {
                    Ok(instructions) => row.instructions = Some(instructions),
                    Err(failure) => row.failure = Some(failure.to_string()),
                }
            }
        }
        rows.push(row);
    }
    progress(rungs.len());
    let savings = Saving::all(&rows);
    Ladder { scene: scene.name.clone(), chosen: scene.rung(), rows, savings }
}

fn quickest(rung: Rung, scene: &Scene) -> Result<Played, PlayFailure> {
    let mut best = rung.play(scene, NonZeroUsize::MIN)?;
    for _ in 1..RUNS {
        best.in_steps = best.in_steps.min(rung.play(scene, NonZeroUsize::MIN)?.in_steps);
    }
    Ok(best)
}

/// Largest distance and angle between two paths.
pub(super) fn apart(a: &[[f64; 7]], b: &[[f64; 7]]) -> (f64, f64) {
    let mut largest = (0.0_f64, 0.0_f64);
    for (a, b) in a.iter().zip(b) {
        let way = Vector3::new(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
        let q = |x: &[f64; 7]| Quaternion::from_array([x[3], x[4], x[5], x[6]]);
        let turn = q(a).conjugate().product(q(b));
        largest.0 = largest.0.max(way.norm());
        largest.1 = largest.1.max(2.0 * turn.v.norm().atan2(turn.s.abs()));
    }
    largest
}

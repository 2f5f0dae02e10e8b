//! All rungs of the ladder of bodies and joints, with what each costs and how far it is off.

use super::ladder::{RUNS, apart};
use super::play::{PlayFailure, Played, fly};
use super::step_count::count;
use crate::callgrind::word;
use serde::Serialize;
use std::cell::RefCell;
use std::num::NonZeroUsize;
use surefoot_multibody::ConstrainedSimulation;
use surefoot_sim::mechanism::{
    ChosenModel, MechanismModel, Moving, Started, start_bodies, start_model,
};
use surefoot_sim::scene::MechanismScene;

/// A model of bodies and joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum MechanismRung {
    /// Coordinates of all bodies, with joints as constraints and their multipliers: (5.11).
    Multipliers,
    /// All bodies in joint coordinates.
    JointCoordinates,
    /// Links on fixed joints merged.
    Merged,
    /// In the plane that the motion stays in.
    Planar,
    /// One free body, with nothing of a tree.
    SingleBody,
}

/// A rung's figures.
#[derive(Clone, Debug, Serialize)]
pub struct MechanismRow {
    /// Which one.
    pub rung: MechanismRung,
    /// Bodies that are computed.
    pub bodies: usize,
    /// What Newton's method solves for.
    pub unknowns: Option<usize>,
    /// Instructions of a step, the mean over the motion; none without valgrind.
    pub instructions: Option<u64>,
    /// Time of a step, the mean over the motion, the least of some runs, µs.
    pub us_per_step: Option<f64>,
    /// How far a body is from where all bodies in joint coordinates have it, at most, m.
    pub deviation_m: Option<f64>,
    /// How far it is turned away, at most, rad.
    pub deviation_rad: Option<f64>,
    /// Why the rung could not be played, or its instructions not be counted.
    pub failure: Option<String>,
}

/// A ladder.
#[derive(Clone, Debug, Serialize)]
pub struct MechanismLadder {
    /// The scene's name.
    pub scene: String,
    /// What `run` plays it with, and why.
    pub chosen: ChosenModel,
    /// Every rung, from the dearest to the cheapest.
    pub rows: Vec<MechanismRow>,
}

/// What is played of a motion, s: errors of a chaotic one grow, whatever makes them.
const PLAYED_S: f64 = 1.0;
/// Instructions are counted over this much of it, s.
const COUNTED_S: f64 = 0.3;

impl MechanismRung {
    /// Those that a scene bears, from the dearest to the cheapest.
    pub fn of(scene: &MechanismScene) -> Vec<Self> {
        let mut all = [
            Self::Multipliers,
            Self::JointCoordinates,
            Self::Merged,
            Self::Planar,
            Self::SingleBody,
        ];
        let touches = |started: Started| !started.moving.contacts().is_empty();
        // One body that can touch a floor costs less in its plane than in space.
        if start_model(scene, None).is_ok_and(touches) {
            all.swap(3, 4);
        }
        let bears = |rung: &Self| match rung.model() {
            None => has_constraints_only(scene),
            Some(model) => start_model(scene, Some(model)).is_ok(),
        };
        all.into_iter().filter(bears).collect()
    }

    /// None for multipliers.
    fn model(self) -> Option<MechanismModel> {
        Some(match self {
            Self::Multipliers => return None,
            Self::JointCoordinates => MechanismModel::Full,
            Self::Merged => MechanismModel::Merged,
            Self::Planar => MechanismModel::Planar,
            Self::SingleBody => MechanismModel::SingleBody,
        })
    }

    /// Plays the motion with this many equal copies of the model side by side, which differ in nothing but what
    /// they cost.
    ///
    /// # Errors
    /// A [`PlayFailure`].
    pub fn play(self, scene: &MechanismScene, copies: NonZeroUsize) -> Result<Played, PlayFailure> {
        let h = scene.integrator.step_s;
        let steps = (scene.duration_s / h).round().max(1.0) as u64;
        let Some(model) = self.model() else {
            let mut full = start_bodies(&scene.mechanism, h)?;
            let (states, rates) = (full.states(), full.rates()?);
            let one = ConstrainedSimulation::new(full.system().clone(), h, states, rates)?;
            let unknowns = one.unknowns();
            let copies = vec![one; copies.get()];
            return fly(copies, steps, unknowns, ConstrainedSimulation::step, |one| {
                one.states().to_vec()
            });
        };
        let one = || Ok(RefCell::new(start_model(scene, Some(model))?.moving));
        let copies: Result<Vec<RefCell<Box<dyn Moving>>>, PlayFailure> =
            (0..copies.get()).map(|_| one()).collect();
        let copies = copies?;
        let unknowns = copies.first().map_or(0, |one| one.borrow().unknowns());
        fly(
            copies,
            steps,
            unknowns,
            |one| one.get_mut().step(),
            |one| {
                // A motion that has no velocities any more fails at the next step.
                let states = one.borrow_mut().state().map(|(states, _)| states).unwrap_or_default();
                states.as_chunks().0.to_vec()
            },
        )
    }
}

/// Whether there is nothing but bodies, joints and weight: more the text's equations are not written for.
fn has_constraints_only(scene: &MechanismScene) -> bool {
    let Ok(full) = start_bodies(&scene.mechanism, scene.integrator.step_s) else { return false };
    let system = full.system();
    let is_driven = match &scene.mechanism {
        surefoot_sim::scene::Mechanism::Multibody(all) => {
            all.bodies.iter().any(|body| body.torque != 0.0)
        }
        _ => false,
    };
    !is_driven
        && system.laws().is_empty()
        && system.ground().is_none()
        && system.closures().is_empty()
        && system.strikers().is_empty()
}

/// Plays all rungs of a scene of bodies and joints, which can be opened by `name`; some seconds with valgrind.
/// `progress` is told how many rungs are done.
///
/// # Errors
/// A [`PlayFailure`] for a scene that cannot be started, or that has no bodies and joints.
pub fn climb_mechanism(
    name: &str,
    scene: &MechanismScene,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<MechanismLadder, PlayFailure> {
    let full = start_bodies(&scene.mechanism, scene.integrator.step_s)?;
    let Started { model, .. } = start_model(scene, None)?;
    let chosen = model.ok_or(surefoot_sim::mechanism::StartFailure::OneModel)?;
    let mut scene = scene.clone();
    scene.duration_s = scene.duration_s.min(PLAYED_S);
    let reference = quickest(MechanismRung::JointCoordinates, &scene)?;
    let mut rows = Vec::new();
    let rungs = MechanismRung::of(&scene);
    for (done, rung) in rungs.iter().enumerate() {
        progress(done);
        let bodies = match rung.model() {
            None | Some(MechanismModel::Full) => full.system().links().len(),
            wanted => start_model(&scene, wanted)?.model.map_or(0, |chosen| chosen.bodies),
        };
        let mut row = MechanismRow {
            rung: *rung,
            bodies,
            unknowns: None,
            instructions: None,
            us_per_step: None,
            deviation_m: None,
            deviation_rad: None,
            failure: None,
        };
        match quickest(*rung, &scene) {
            Err(failure) => row.failure = Some(failure.to_string()),
            Ok(played) => {
                row.unknowns = Some(played.unknowns);
                row.us_per_step =
                    Some(played.in_steps.as_secs_f64() * 1e6 / played.steps.max(1) as f64);
                let (m, rad) = apart(&reference.path, &played.path);
                (row.deviation_m, row.deviation_rad) = (Some(m), Some(rad));
                let counted_s = scene.duration_s.min(COUNTED_S);
                let steps = (counted_s / scene.integrator.step_s).round() as u64;
                match count(name, counted_s, &word(*rung), steps) {
                    Ok(instructions) => row.instructions = Some(instructions),
                    Err(failure) => row.failure = Some(failure.to_string()),
                }
            }
        }
        rows.push(row);
    }
    progress(rungs.len());
    Ok(MechanismLadder { scene: scene.name.clone(), chosen, rows })
}

fn quickest(rung: MechanismRung, scene: &MechanismScene) -> Result<Played, PlayFailure> {
    let mut best = rung.play(scene, NonZeroUsize::MIN)?;
    for _ in 1..RUNS {
        best.in_steps = best.in_steps.min(rung.play(scene, NonZeroUsize::MIN)?.in_steps);
    }
    Ok(best)
}

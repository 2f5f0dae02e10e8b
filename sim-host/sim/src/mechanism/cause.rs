//! Why a run ended early, from evidence: the same motion in shorter steps, and under other methods.
//!
//! A step is named only if it was shorter than the one that failed, and if a motion in such steps has got past the
//! instant of the failure: in a trial. Trials cost no more than [`Budget`] allows, which counts steps, not seconds, so
//! that a run says the same on every machine.

use super::model::MechanismModel;
use super::moving::Moving;
use super::run::ROUND_OFF;
use super::start::start_model;
use crate::scene::MechanismScene;
use serde::Serialize;
use surefoot_mechanics::integrators::{Method, StepError, StepFailure};

/// What trials have found.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case", tag = "kind")]
pub enum Cause {
    /// In steps of this length the run completes.
    StepTooLong {
        /// s
        step_s: f64,
    },
    /// Steps of this length get past the instant, from this time on; more would have cost too much.
    StepTooLongHere {
        /// s
        step_s: f64,
        /// s
        from_s: f64,
    },
    /// Shorter steps fail at the same instant; another method does not, if one is named.
    NotTheStep {
        /// The shortest step that was tried, s.
        down_to_s: f64,
        /// It completes the run in the scene's steps, and keeps the energy.
        method: Option<Method>,
    },
    /// Shorter steps fail as well, but at other times.
    ShorterFailToo {
        /// The shortest step that was tried, s.
        down_to_s: f64,
    },
    /// The motion itself cannot go on: no step helps.
    NoStepHelps,
    /// Trials would have cost too much.
    NotTried,
}

impl Cause {
    /// The step that has been tried and works, s.
    pub fn step_s(&self) -> Option<f64> {
        match self {
            Self::StepTooLong { step_s } | Self::StepTooLongHere { step_s, .. } => Some(*step_s),
            _ => None,
        }
    }
}

/// A motion that was kept on the way, and when.
pub(super) struct Kept {
    pub time_s: f64,
    pub moving: Box<dyn Moving>,
}

/// Unknowns of steps that trials may solve for, all together.
const BUDGET: f64 = 2e7;
/// Parts that a step is made in, in trials.
const PARTS: [u32; 14] = [2, 4, 8, 16, 20, 32, 40, 64, 100, 128, 200, 256, 512, 1024];
/// Failures within so many of the scene's steps are at the same instant.
const SAME: f64 = 2.5;
/// Steps of the scene beyond the instant that a trial has to make.
const BEYOND: f64 = 5.0;
/// Share of the largest kinetic energy that a method may be off.
const KEPT: f64 = 1e-2;

/// What is left for trials.
struct Budget {
    left: f64,
    unknowns: f64,
}

impl Budget {
    /// Whether so many steps can be paid for.
    fn has(&self, steps: f64) -> bool {
        steps * self.unknowns <= self.left
    }

    /// Steps, until a time: when it fails, if it does.
    fn play(&mut self, moving: &mut dyn Moving, until_s: f64) -> Result<(), f64> {
        while moving.progress().time_s < until_s - 0.5 * moving.progress().h {
            self.left -= self.unknowns;
            moving.step().map_err(|error| error.time_s)?;
        }
        Ok(())
    }
}

/// The cause of a failure of a scene's run, with a motion kept not long before.
pub(super) fn cause(
    scene: &MechanismScene,
    wanted: Option<MechanismModel>,
    (failure, unknowns): (&StepError, usize),
    kept: Option<&Kept>,
) -> Cause {
    if let StepFailure::GimbalLock { .. } = failure.failure {
        return Cause::NoStepHelps;
    }
    let h = scene.integrator.step_s;
    let past = (failure.time_s + BEYOND * h).min(scene.duration_s.max(failure.time_s + h));
    let mut budget = Budget { left: BUDGET, unknowns: unknowns.max(1) as f64 };
    let start = |h: f64, method: Method| {
        let mut scene = scene.clone();
        (scene.integrator.step_s, scene.integrator.name) = (h, method);
        // Smaller models are the method's that the scene names.
        let wanted = wanted.filter(|_| method == Method::Variational);
        start_model(&scene, wanted).ok().map(|started| started.moving)
    };
    let method = scene.integrator.name;
    let (mut shortest, mut all_at_once) = (None, true);
    let mut here = None;
    for parts in PARTS {
        let step_s = h / f64::from(parts);
        let mut failed = |time_s: f64| {
            shortest = Some(step_s);
            all_at_once &= (time_s - failure.time_s).abs() <= SAME * h;
        };
        let again = kept.and_then(|kept| Some((kept.time_s, kept.moving.in_steps_of(step_s)?)));
        if let Some((from_s, mut moving)) = again {
            if !budget.has((past - from_s) / step_s) {
                break;
            }
            if let Err(after) = budget.play(moving.as_mut(), past - from_s) {
                failed(from_s + after);
                continue;
            }
            here = here.or(Some(Cause::StepTooLongHere { step_s, from_s }));
        }
        let until_s = if budget.has(scene.duration_s / step_s) { scene.duration_s } else { past };
        if !budget.has(until_s / step_s) {
            break;
        }
        let Some(mut moving) = start(step_s, method) else { break };
        match budget.play(moving.as_mut(), until_s) {
            Ok(()) if until_s < scene.duration_s => {
                return Cause::StepTooLongHere { step_s, from_s: 0.0 };
            }
            Ok(()) => return Cause::StepTooLong { step_s },
            Err(time_s) => failed(time_s),
        }
    }
    match (here, shortest) {
        (Some(here), None) => here,
        (_, Some(down_to_s)) if !all_at_once => Cause::ShorterFailToo { down_to_s },
        (_, Some(down_to_s)) => {
            let others = [Method::Variational, Method::RungeKutta4, Method::DormandPrince8];
            let completes = |other: &Method| {
                *other != method
                    && budget.has(scene.duration_s / h)
                    && start(h, *other)
                        .is_some_and(|mut moving| keeps(moving.as_mut(), scene, &mut budget))
            };
            Cause::NotTheStep { down_to_s, method: others.into_iter().find(completes) }
        }
        (None, None) => Cause::NotTried,
    }
}

/// Whether a motion completes the scene and keeps its energy, which is to be one that keeps it.
fn keeps(moving: &mut dyn Moving, scene: &MechanismScene, budget: &mut Budget) -> bool {
    let (mut low, mut high, mut kinetic) = (f64::INFINITY, f64::NEG_INFINITY, 0.0_f64);
    loop {
        let (Ok((energy, ..)), Ok((x, v))) = (moving.conserved(), moving.state()) else {
            return false;
        };
        (low, high, kinetic) =
            (low.min(energy), high.max(energy), kinetic.max(moving.kinetic(&x, &v)));
        // NaN keeps nothing.
        let is_kept = high - low <= KEPT * kinetic + ROUND_OFF * low.abs().max(high.abs());
        if moving.keeps_energy() && !is_kept {
            return false;
        }
        let until_s = scene.duration_s;
        if moving.progress().time_s >= until_s - 0.5 * moving.progress().h {
            return true;
        }
        let next = moving.progress().time_s + moving.progress().h;
        if budget.play(moving, next).is_err() {
            return false;
        }
    }
}

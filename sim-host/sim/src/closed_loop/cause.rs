//! Why a run of a robot ended early: what its record says, and what trials say.
//!
//! A shorter step, a higher rate, or better hardware is named only where a run with it has completed. What shorter
//! steps do at the same instant tells whether the step was too long, or the loop runs away whatever the step.

use super::{Failure, Run};
use crate::plant::StepFailure;
use crate::record::Sample;
use crate::robot::Robot;
use crate::scene::Scene;
use serde::Serialize;
use std::fmt::Write;
use surefoot_multibody::contact::ContactState;

/// What is known of a run's end.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Cause {
    /// The first torque beyond what any balance takes.
    pub runaway: Option<Runaway>,
    /// Feet that touch nothing at the end, where contact is modelled.
    pub feet_off: usize,
    /// What shorter steps do.
    pub steps: StepTrial,
    /// What completes the run.
    pub remedy: Option<Remedy>,
}

/// A torque that has run away.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Runaway {
    /// Which joint, by its number.
    pub joint: usize,
    /// Its name.
    #[serde(skip)]
    pub name: String,
    /// N·m
    pub torque_nm: f64,
    /// s
    pub time_s: f64,
}

/// What shorter steps do.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case", tag = "kind")]
pub enum StepTrial {
    /// None has been tried.
    #[default]
    NotTried,
    /// The run completes with this one, s.
    Completes {
        /// s
        step_s: f64,
    },
    /// All fail at the same instant, within two ticks.
    SameInstant {
        /// The shortest, s.
        down_to_s: f64,
    },
    /// They fail too, some at other times.
    OtherInstant {
        /// The shortest, s.
        down_to_s: f64,
    },
}

/// What completes a run that shorter steps do not.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case", tag = "kind")]
pub enum Remedy {
    /// A higher rate of control.
    Rate {
        /// Hz
        rate_hz: f64,
    },
    /// Sensors and motors without errors, delay and limits.
    IdealHardware,
}

/// A torque that holds more than this many times the weight at the arm of its height is none of a balance.
const WEIGHTS: f64 = 3.0;
/// Parts of a step, and of a tick, in trials.
const PARTS: [u32; 4] = [2, 4, 8, 16];
/// Steps that trials may make, all together.
const BUDGET: u64 = 400_000;

impl Cause {
    /// What the record alone says.
    pub(super) fn of_record(samples: &[Sample], robot: &Robot) -> Self {
        Self { runaway: runaway(samples, robot), feet_off: feet_off(samples), ..Self::default() }
    }

    /// The same for people: what to try, and why.
    pub fn advice(&self) -> String {
        let mut out = String::new();
        // Writing to a string cannot fail.
        let _ = self.write(&mut out);
        out
    }

    fn write(&self, out: &mut String) -> std::fmt::Result {
        if let StepTrial::Completes { step_s } = self.steps {
            return write!(out, "a shorter step: with {step_s:.3e} s the run completes (tried)");
        }
        if let Some(Runaway { name, torque_nm, time_s, .. }) = &self.runaway {
            write!(
                out,
                "the control loop runs away, {torque_nm:.0} N·m in {name} at {time_s:.3} s: a higher rate, a shorter \
                 delay, lower gains"
            )?;
        } else if self.feet_off > 0 {
            let feet = match self.feet_off {
                1 => "one foot is".to_owned(),
                2 => "both feet are".to_owned(),
                more => format!("{more} feet are"),
            };
            write!(out, "{feet} off the floor at the end: see in the record when they left it")?;
        } else {
            out.push_str("see the record of the last ticks");
        }
        match self.steps {
            StepTrial::NotTried | StepTrial::Completes { .. } => {}
            StepTrial::SameInstant { down_to_s } => {
                write!(out, "; not the step: {down_to_s:.1e} s fails at the same instant (tried)")?;
            }
            StepTrial::OtherInstant { down_to_s } => {
                write!(out, "; steps down to {down_to_s:.1e} s fail too, at other times (tried)")?;
            }
        }
        match self.remedy {
            Some(Remedy::Rate { rate_hz }) => {
                write!(out, "; at a control rate of {rate_hz:.4} Hz the run completes (tried)")
            }
            Some(Remedy::IdealHardware) => {
                write!(out, "; with ideal sensors and motors the run completes (tried)")
            }
            None => Ok(()),
        }
    }
}

/// The first torque beyond [`WEIGHTS`]. At the start the potential energy is weight times height.
fn runaway(samples: &[Sample], robot: &Robot) -> Option<Runaway> {
    let bound = WEIGHTS * samples.first()?.energy[1];
    samples.iter().filter(|_| bound > 0.0).find_map(|sample| {
        let joint = sample.torques.iter().position(|torque| torque.abs() > bound)?;
        let name = robot.joints.get(joint).cloned().unwrap_or_default();
        Some(Runaway { joint, name, torque_nm: sample.torques[joint], time_s: sample.time_s })
    })
}

fn feet_off(samples: &[Sample]) -> usize {
    let contacts = samples.last().and_then(|sample| sample.contacts.as_ref());
    let is_off = |foot: &&Vec<ContactState>| foot.iter().all(|c| *c == ContactState::Free);
    contacts.into_iter().flatten().filter(is_off).count()
}

/// Tells why a run ended early, with trials by `again`, which plays a scene from its start with the same controller;
/// it tells nothing where it cannot.
///
/// # Cost
/// Some runs of the scene, in shorter steps; nothing for a run that has not failed.
pub fn explain(scene: &Scene, run: &mut Run, again: &mut dyn FnMut(&Scene) -> Option<Run>) {
    let explained = ["step", "fell", "stopped"];
    let Some(failure) = run.failure.as_mut().filter(|f| explained.contains(&f.kind)) else {
        return;
    };
    let is_stopped = failure.kind == "stopped";
    let mut cause = Cause::of_record(&run.samples, &scene.robot());
    let mut left = BUDGET;
    let mut play = |scene: &Scene| {
        let steps = (scene.duration_s / scene.integrator.step_s) as u64;
        left = left.checked_sub(steps)?;
        scene.check().ok()?;
        again(scene)
    };
    let tick_s = 1.0 / scene.controller.rate_hz;
    let mut all_at_once = true;
    for parts in PARTS {
        let mut shorter = scene.clone();
        shorter.integrator.step_s /= f64::from(parts);
        let step_s = shorter.integrator.step_s;
        let Some(run) = play(&shorter) else { break };
        let Some(other) = run.failure else {
            cause.steps = StepTrial::Completes { step_s };
            break;
        };
        all_at_once &= (other.time_s - failure.time_s).abs() <= 2.0 * tick_s;
        cause.steps = match all_at_once {
            true => StepTrial::SameInstant { down_to_s: step_s },
            false => StepTrial::OtherInstant { down_to_s: step_s },
        };
    }
    if matches!(cause.steps, StepTrial::SameInstant { .. } | StepTrial::OtherInstant { .. }) {
        let mut completes = |scene: &Scene| play(scene).is_some_and(|run| run.failure.is_none());
        let is_ideal = scene.acting.is_ideal() && scene.sensing.is_ideal();
        let ideal =
            Scene { acting: Default::default(), sensing: Default::default(), ..scene.clone() };
        if !is_ideal && completes(&ideal) {
            cause.remedy = Some(Remedy::IdealHardware);
        } else if cause.runaway.is_some() || is_stopped {
            // A tick is a whole number of steps.
            let step_s = scene.integrator.step_s;
            let steps = (tick_s / step_s).round() as u32;
            let faster = PARTS.map(|parts| 1.0 / (f64::from((steps / parts).max(1)) * step_s));
            let found = faster.into_iter().find(|rate_hz| {
                let mut faster = scene.clone();
                faster.controller.rate_hz = *rate_hz;
                completes(&faster)
            });
            cause.remedy = found.map(|rate_hz| Remedy::Rate { rate_hz });
        }
    }
    // A fall has advice of its own, unless more is known.
    let is_known = cause.runaway.is_some()
        || cause.remedy.is_some()
        || matches!(cause.steps, StepTrial::Completes { .. });
    if is_stopped && is_known {
        // The supervisor's reason stays.
        failure.advice = format!("{}; {}", failure.advice, cause.advice());
    } else if failure.kind == "step" || is_known {
        failure.advice = cause.advice();
        with_hardware(failure, scene);
    }
    run.cause = Some(cause);
}

/// Adds what is not ideal about a scene's sensors and motors, which a failure may be due to.
pub(super) fn with_hardware(failure: &mut Failure, scene: &Scene) {
    if failure.kind == "resume" {
        return;
    }
    let delay_ms = scene.acting.delay_s * 1e3;
    if delay_ms > 0.0 {
        let late = format!("; the motors are {delay_ms} ms late: perhaps a shorter delay");
        failure.advice.push_str(&late);
    }
    if scene.acting.torque_limits_nm.is_some() {
        failure.advice.push_str("; the motors are limited: perhaps stronger ones");
    }
    if !scene.sensing.is_ideal() {
        failure.advice.push_str("; the sensors are not ideal: perhaps better ones, or lower gains");
    }
}

/// A step that failed, before anything is known of it but the record.
pub(super) fn step_failure(time_s: f64, failure: StepFailure) -> Failure {
    let advice = match failure {
        StepFailure::SingularConstraints => "bend the knees",
        StepFailure::Dynamics(_) | StepFailure::System(_) => "check the initial state",
        StepFailure::Diverged { .. } | StepFailure::BlockDiverged { .. } | StepFailure::Step(_) => {
            "see the record of the last ticks"
        }
    };
    Failure { kind: "step", time_s, place: failure.to_string(), advice: advice.into() }
}

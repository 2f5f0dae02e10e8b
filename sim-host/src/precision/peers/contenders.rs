//! MuJoCo's integrators on a problem, measured as all methods are.

use super::super::contender::{Contender, Runs};
use super::super::course::landmarks;
use super::super::measure::{Failed, Level, Played, Span};
use super::super::problem::{Omission, Problem};
use super::MUJOCO_INTEGRATORS;
use super::mjcf::{MujocoModel, mujoco_model};
use super::mujoco::{Mujoco, NoMujoco};
use serde::{Deserialize, Serialize};
use std::sync::Arc;
use surefoot_multibody::{BodyState, System};
use surefoot_sim::mechanism::start_bodies;

/// All integrators on a problem, or why they do not play it.
pub(in super::super) fn peer_contenders(
    problem: &Problem,
    mujoco: &Arc<Mujoco>,
) -> Result<Vec<Contender>, Omission> {
    let omitted =
        |reason: String| Omission { method: format!("MuJoCo {}", mujoco.version), reason };
    let scene = problem.scene.as_ref().ok_or_else(|| {
        omitted(
            "its floor is another one: what it is off by would be the model's, not the method's"
                .to_owned(),
        )
    })?;
    let mut simulation = start_bodies(&scene.mechanism, scene.integrator.step_s)
        .map_err(|failure| omitted(failure.to_string()))?;
    let system = Arc::new(simulation.system().clone());
    if system.ground().is_some() {
        let reason =
            "its contact is another one: what it is off by would be the model's, not the method's";
        return Err(omitted(reason.to_owned()));
    }
    if scene.mechanism.torques().iter().any(|torque| *torque != 0.0) {
        return Err(omitted("motors' torques are not written".to_owned()));
    }
    let model = mujoco_model(&mut simulation).map_err(|no_model| omitted(no_model.to_string()))?;
    let model = Arc::new(model);
    let each = MUJOCO_INTEGRATORS.map(|(integrator, order, evaluations)| Contender {
        name: format!("mujoco-{}-{integrator}", mujoco.version),
        order: Some(order),
        levels: Contender::levels_of_steps(),
        runs: Box::new(MujocoRuns {
            mujoco: Arc::clone(mujoco),
            model: Arc::clone(&model),
            system: Arc::clone(&system),
            integrator,
            evaluations,
        }),
        foretell: Box::new(|| None),
    });
    Ok(each.into())
}

struct MujocoRuns {
    mujoco: Arc<Mujoco>,
    model: Arc<MujocoModel>,
    system: Arc<System>,
    integrator: &'static str,
    /// A step's.
    evaluations: u64,
}

#[derive(Serialize)]
struct Request<'a> {
    model: &'a MujocoModel,
    integrator: &'a str,
    step_s: f64,
    samples: u32,
    divisions: u32,
    is_timed: bool,
}

#[derive(Deserialize)]
struct Motion {
    /// Of all bodies, at the samples.
    places: Vec<Vec<BodyState>>,
    energies: Vec<[f64; 2]>,
    failed_at_s: Option<f64>,
}

#[derive(Deserialize)]
struct Time {
    seconds: Option<f64>,
}

impl MujocoRuns {
    fn request(&self, span: &Span, level: Level, is_timed: bool) -> Request<'_> {
        let Span { samples, .. } = *span;
        let (model, integrator) = (self.model.as_ref(), self.integrator);
        let step_s = self.step_s(span, level);
        Request { model, integrator, step_s, samples, divisions: level.divisions, is_timed }
    }
}

impl Runs for MujocoRuns {
    fn step_s(&self, span: &Span, level: Level) -> f64 {
        span.duration_s / f64::from(span.samples) / f64::from(level.divisions)
    }

    fn play(&self, span: &Span, level: Level) -> Played {
        let steps = u64::from(span.samples) * u64::from(level.divisions);
        let evaluations = steps * self.evaluations;
        let made: Result<Motion, NoMujoco> = self.mujoco.ask(&self.request(span, level, false));
        match made {
            Ok(Motion { places, energies, failed_at_s }) => Played {
                places: places.iter().map(|states| landmarks(&self.system, states)).collect(),
                energies,
                steps,
                evaluations,
                failure: failed_at_s.map(|time_s| Failed {
                    time_s,
                    reason: "MuJoCo has begun anew: its motion diverged".to_owned(),
                }),
                ..Played::default()
            },
            Err(error) => {
                let failure = Some(Failed { time_s: 0.0, reason: error.to_string() });
                Played { steps, evaluations, failure, ..Played::default() }
            }
        }
    }

    fn time(&self, span: &Span, level: Level) -> Option<f64> {
        let time: Time = self.mujoco.ask(&self.request(span, level, true)).ok()?;
        time.seconds
    }
}

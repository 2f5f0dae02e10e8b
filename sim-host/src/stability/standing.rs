//! The standing robot: how long the plant's steps may be under the controller.

use super::loop_limits::{Criterion, Ending, Loop, Manner, play};
use super::maps::{Axis, Foretold, edge, should_land, should_stand};
use super::problem::Problem;
use surefoot_mechanics::forecast::Forecast;
use surefoot_mechanics::forecast::{FailureKind, Verdict};
use surefoot_mechanics::integrators::Method;
use surefoot_multibody::{Simulation, StepForecast};
use surefoot_sim::plant::{OnFloor, Plant};
use surefoot_sim::robot::Start;
use surefoot_sim::scene::{Feet, Scene};

/// Steps in question, s.
const RANGE_S: [f64; 2] = [5e-5, 0.2];
/// Samples of a run to a forecast of how fast the robot turns.
const EVERY: usize = 20;

/// A robot's scene on both plants, for so many seconds at least. A control period has a whole number of
/// steps: those that are asked for are shortened to that, and where they are longer, the period is one step.
pub fn standing(scene: Scene, least_duration_s: f64) -> Problem {
    let period_s = 1.0 / scene.controller.rate_hz;
    let foretold = scene.clone();
    Problem {
        name: "biped-standing",
        description: "Experiment 1 under its controller; steps go into its period of 2 ms, longer ones are its period",
        range_s: RANGE_S,
        period_s: Some(period_s),
        attempt: Box::new(move |method, h| {
            is_plant(method).then(|| attempt(&scene, least_duration_s, method, h))
        }),
        foretell: Box::new(move |method| {
            is_plant(method).then(|| forecast(&foretold, least_duration_s, method))
        }),
    }
}

fn is_plant(method: Method) -> bool {
    matches!(method, Method::Variational | Method::SemiImplicitEuler)
}

fn attempt(scene: &Scene, least_duration_s: f64, method: Method, h: f64) -> Verdict {
    let criterion = Criterion { least_duration_s, ..Criterion::default() };
    let mut scene = scene.clone();
    let period_s = 1.0 / scene.controller.rate_hz;
    let step_s = if h > period_s {
        scene.controller.rate_hz = 1.0 / h;
        h
    } else {
        // A ratio that is whole but for round-off is whole.
        period_s / (period_s / h - 1e-9).ceil().max(1.0)
    };
    (scene.integrator.name, scene.integrator.step_s) = (method, step_s);
    scene.duration_s = scene.duration_s.max(criterion.least_duration_s);
    let (run, fault) = play(&scene, Loop::Bare);
    let time_s = run.samples.last().map_or(0.0, |sample| sample.time_s);
    match (Ending { scene: &scene, run: &run, fault }).manner(&criterion) {
        None => Verdict::Works,
        Some(manner) => Verdict::Fails { kind: kind(method, manner), time_s },
    }
}

fn kind(method: Method, manner: Manner) -> FailureKind {
    match manner {
        Manner::StepFailure if method == Method::Variational => FailureKind::NoRoot,
        Manner::StepFailure | Manner::Runaway => FailureKind::Runaway,
        _ => FailureKind::Unbalanced,
    }
}

/// The baseline plant knows its floor's limit. Of the variational one the floor limits nothing: what does is
/// how far a body turns in a step, on the run in the scene's own steps. Of either, steps that are control periods
/// are limited by what the sampled loop asks of the ground, and by how it comes down there in such steps.
fn forecast(scene: &Scene, least_duration_s: f64, method: Method) -> Forecast {
    let plant = match (method, &scene.feet) {
        (Method::SemiImplicitEuler, Feet::Floor { outline: Some(outline), floor }) => {
            let stops = scene.acting.joint_stops.map(|stops| stops.in_radians().to_vec());
            let plant = OnFloor::new(&scene.initial.state(), *floor, &outline.sole());
            (plant.with_stops(stops).step_limit(), FailureKind::Runaway)
        }
        (Method::Variational, _) => (turning(scene).turning_s, FailureKind::NoRoot),
        _ => (None, FailureKind::Runaway),
    };
    let criterion = Criterion { least_duration_s, ..Criterion::default() };
    let own_s = 1.0 / scene.controller.rate_hz;
    let at = |period_s: f64, step_s: f64| {
        let mut scene = scene.clone();
        scene.controller.rate_hz = 1.0 / period_s;
        scene.integrator.step_s = period_s / (period_s / step_s - 1e-9).ceil();
        scene
    };
    let stands = |period_s| should_stand(&at(period_s, scene.integrator.step_s), &criterion);
    // The floor's own limit of the baseline is far below a control period.
    let lands = |period_s| method != Method::Variational || should_land(&at(period_s, period_s));
    let periods = Axis::logarithmic("period", "s", [own_s, RANGE_S[1]]);
    let sampled_s = match edge(&periods, stands, lands) {
        Foretold::At(period_s) => period_s,
        // Steps below the period change nothing about it.
        Foretold::NothingWorks => {
            return Forecast { step_s: None, kind: Some(FailureKind::Unbalanced) };
        }
        Foretold::Unlimited => RANGE_S[1],
    };
    let (step_s, kind) = match plant {
        (Some(step_s), _) if step_s < sampled_s => plant,
        _ => (Some(sampled_s), FailureKind::Unbalanced),
    };
    Forecast { step_s, kind: Some(kind) }
}

/// How fast bodies turn in the run of a scene.
fn turning(scene: &Scene) -> StepForecast {
    let mut all = StepForecast::default();
    let (run, _) = play(scene, Loop::Bare);
    let tree = &scene.robot().tree;
    for sample in run.samples.iter().step_by(EVERY) {
        let here = tree.start(&sample.positions, &sample.velocities).ok();
        let forecast = here.and_then(|Start { system, states, rates, .. }| {
            let h = scene.integrator.step_s;
            let mut simulation = Simulation::new(system, h, &states, &rates).ok()?;
            simulation.forecast().ok()
        });
        all = forecast.map_or(all, |forecast| all.and(forecast));
    }
    all
}

//! A robot under its controller: the simulator's plant, and the baseline to compare with.

use super::contender::{Contender, Foretell, Runs};
use super::measure::{Failed, Level, Played, Span};
use super::problem::{Omission, Problem};
use crate::stability::standing;
use cpu_time::ThreadTime;
use surefoot_mechanics::integrators::Method;
use surefoot_sim::closed_loop::{Run, Scalar, controller, run};
use surefoot_sim::scene::Scene;

/// Steps within a tick of each method, coarsest first: the floor bounds the baseline's.
const STEPS: [(Method, &[u32]); 2] = [
    (Method::Variational, &[1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128]),
    (Method::SemiImplicitEuler, &[12, 16, 20, 24, 32, 48, 64, 96, 128, 192, 256, 384, 512]),
];

/// The problem of a robot's scene. Its places are the robot's 19 coordinates, m and rad; all ticks of the
/// controller are in the time that it takes.
pub(super) fn closed_loop(scene: &Scene) -> Problem {
    let contenders = STEPS.map(|(method, divisions)| {
        let level = |divisions: &u32| Level { divisions: *divisions, tolerance: None };
        Contender {
            name: method.name(),
            order: method.order(),
            levels: divisions.iter().map(level).collect(),
            runs: Box::new(InLoop { scene: scene.clone(), method }),
            foretell: foretell(scene, method),
        }
    });
    let omitted = Method::all().iter().filter(|m| STEPS.iter().all(|(method, _)| method != *m));
    let ticks = (scene.duration_s * scene.controller.rate_hz).round();
    Problem {
        name: scene.name.clone(),
        description: scene.description.clone(),
        span: Span { duration_s: ticks / scene.controller.rate_hz, samples: 20 },
        contenders: contenders.into(),
        omitted: omitted
            .map(|method| Omission {
                method: method.name(),
                reason: "plants that touch a floor have two methods".to_owned(),
            })
            .collect(),
        keeps_energy: false,
        closed_form: None,
        scene: None,
    }
}

/// What [`standing`] foretells, for the scene's duration.
fn foretell(scene: &Scene, method: Method) -> Foretell {
    let scene = scene.clone();
    Box::new(move || standing(scene.clone(), scene.duration_s).forecast(method)?.step_s)
}

struct InLoop {
    scene: Scene,
    method: Method,
}

impl InLoop {
    fn run(&self, level: Level) -> Run {
        let mut scene = self.scene.clone();
        scene.integrator.name = self.method;
        scene.integrator.step_s = 1.0 / (scene.controller.rate_hz * f64::from(level.divisions));
        run(&scene, controller(&scene, Scalar::F64).as_mut(), &mut |_| {})
    }
}

impl Runs for InLoop {
    fn step_s(&self, _: &Span, level: Level) -> f64 {
        1.0 / (self.scene.controller.rate_hz * f64::from(level.divisions))
    }

    fn play(&self, span: &Span, level: Level) -> Played {
        let run = self.run(level);
        let ticks = (self.scene.duration_s * self.scene.controller.rate_hz).round();
        let at = |sample: u32| (ticks * f64::from(sample) / f64::from(span.samples)).round();
        let samples = (1..=span.samples).map_while(|k| run.samples.get(at(k) as usize));
        let made = run.progress;
        Played {
            places: samples.map(|sample| sample.positions.to_vec()).collect(),
            energies: Vec::new(),
            momentum_drift: None,
            constraint: None,
            steps: run.steps,
            // The baseline has no solver: one forward dynamics a step.
            evaluations: made.map_or(run.steps, |progress| progress.evaluations),
            newton: made.map(|progress| (progress.mean_iterations(), progress.most_iterations)),
            split_steps: made.map_or(0, |progress| progress.split_steps),
            failure: run.failure.map(|failure| Failed {
                time_s: failure.time_s,
                reason: format!("{}: {}", failure.kind, failure.place),
            }),
        }
    }

    fn time(&self, _: &Span, level: Level) -> Option<f64> {
        let begun = ThreadTime::now();
        let run = self.run(level);
        run.failure.is_none().then(|| begun.elapsed().as_secs_f64())
    }
}

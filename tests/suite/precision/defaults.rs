//! Methods and steps of the built-in scenes are those that the rule recommends; methods on bodies and joints run, or
//! say why not.

use surefoot_host::precision::{
    AdviceError, Among, Effort, Level, Problem, STEP_MARGIN, advise, distance, longest, reference,
    sweep,
};
use surefoot_mechanics::integrators::{Method, StartError};
use surefoot_sim::mechanism::{StartFailure, run, start};
use surefoot_sim::scene::{AnyScene, MechanismScene, built_in, open};

/// Advice's, without times.
const UNTIMED: Effort = Effort { repeats: 0, ..Effort::ADVICE };

fn mechanism(name: &str) -> MechanismScene {
    match open(name).expect("built in") {
        AnyScene::Mechanism(scene) => scene,
        AnyScene::Robot(scene) => panic!("{} is a robot", scene.name),
    }
}

/// The same in a method of its own, which the advice's machinery finds by itself.
fn holds(scene: &MechanismScene, accuracy: f64) {
    let (name, method) = (&scene.name, scene.integrator.name);
    let problem = Problem::of_mechanism(scene).expect("a motion");
    let contender = problem.contenders.iter().find(|c| c.name == method.name());
    let contender = contender.expect("a method that takes the scene");
    let exact = reference(&problem, UNTIMED.most_evaluations).expect("a reference");
    assert!(10.0 * exact.apart <= accuracy, "{name}: sure to {:.1e} only", exact.apart);

    // What the scene's own method and step come to.
    let between = problem.span.duration_s / f64::from(problem.span.samples);
    let divisions = between / scene.integrator.step_s;
    assert!((divisions - divisions.round()).abs() < 1e-9, "{name}: whole steps between samples");
    let tolerance = contender.is_adaptive().then_some(1e-12);
    let level = Level { divisions: divisions.round() as u32, tolerance };
    let played = contender.runs.play(&problem.span, level);
    let places = match &exact.second {
        Some(second) if exact.by == contender.name => second,
        _ => &exact.places,
    };
    let error = distance(&played.places, places).expect("a whole run");
    println!("{name}: {method} at {} s: {error:.1e}", scene.integrator.step_s);
    assert!(error <= accuracy, "{name}: {error:.1e}");

    if contender.is_adaptive() {
        // Taken only where no method with steps of its own gets there.
        for other in problem.contenders.iter().filter(|other| !other.is_adaptive()) {
            let curve = sweep(&problem, other, &exact, &UNTIMED);
            assert_eq!(longest(&curve, accuracy), None, "{name}: {} gets there", other.name);
        }
        return;
    }
    let mut curve = sweep(&problem, contender, &exact, &UNTIMED);
    curve.foretold_s = (contender.foretell)();
    let choice = longest(&curve, accuracy).expect("accurate enough at some step");
    let step = scene.integrator.step_s;
    println!("  the rule: {:.2e} s; {:?}", choice.step_s, choice.limit_s());
    let share = step / choice.step_s;
    assert!((0.7..=1.0).contains(&share), "{name}: {share:.2} of the rule's step");
    let limit = choice.limit_s().expect("a limit seen or foretold");
    assert!(step <= STEP_MARGIN * limit, "{name}: {step} of {limit}");
}

#[test]
fn defaults_of_built_in_scenes_are_what_the_rule_recommends() {
    let scenes = built_in().expect("valid");
    let mut held = Vec::new();
    for scene in &scenes {
        if let AnyScene::Mechanism(scene) = scene
            && let Some(accuracy) = scene.matters.accuracy
        {
            holds(scene, accuracy);
            held.push(scene.name.as_str());
        }
    }
    // Others say in their files why not.
    assert_eq!(held, ["box-drop", "chain", "n-pendulum", "rigid-body", "spherical-pendulum"]);
}

/// The reason that the scene `four-bar` gives for having none.
#[test]
fn nothing_is_recommended_where_nothing_is_known() {
    let problem = Problem::of_mechanism(&mechanism("four-bar")).expect("a motion");
    let effort = Effort { most_evaluations: 10_000, ..UNTIMED };
    let error = advise(&problem, 1e-4, Among::Run, &effort).expect_err("chaotic");
    assert!(matches!(error, AdviceError::Unsure { .. }), "{error}");
}

/// All methods that take bodies and joints come to the same place, by ways that share nothing but the system.
#[test]
fn bodies_run_under_every_method_that_takes_them() {
    for name in ["chain", "biped-flight"] {
        let mut scene = mechanism(name);
        scene.duration_s = 0.5;
        let mut end = |method, step_s| {
            (scene.integrator.name, scene.integrator.step_s) = (method, step_s);
            let run = run(&scene, &mut |_| {}).expect("a method for these");
            assert_eq!(run.failure, None);
            let last = run.samples.last().expect("a sample");
            assert!((last.time_s - 0.5).abs() < 1e-12);
            last.configuration.clone()
        };
        let exact = end(Method::DormandPrince8, 0.05);
        for (method, step, within) in [
            (Method::Variational, 1e-4, 1e-6),
            (Method::Yoshida4, 1e-3, 1e-6),
            (Method::Yoshida6, 5e-3, 1e-6),
            (Method::RungeKutta4, 1e-3, 1e-8),
            (Method::SemiImplicitEuler, 1e-4, 2e-3),
        ] {
            let places = end(method, step);
            let apart = places.iter().zip(&exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            println!("{name}, {method}: {apart:.1e}");
            assert!(apart < within, "{name}, {method}: {apart:.1e}");
        }
    }
}

#[test]
fn a_method_that_does_not_take_the_bodies_says_what_it_takes() {
    for (name, method, words) in [
        ("box-drop", Method::RungeKutta4, "touch nothing"),
        ("box-drop", Method::Yoshida6, "touch nothing"),
        ("four-bar", Method::DormandPrince8, "without closed loops"),
        ("chain", Method::Rattle, "chapter 2"),
    ] {
        let mut scene = mechanism(name);
        scene.integrator.name = method;
        let Err(StartFailure::Method(error @ StartError::NotFor { .. })) = start(&scene) else {
            panic!("{name} starts under {method}");
        };
        assert!(error.to_string().contains(words), "{error}");
    }
}

//! Scenes are played with no more bodies than they need.

use nalgebra::Vector3;
use std::num::NonZeroUsize;
use surefoot::spatial::Quaternion;
use surefoot_host::parsimony::Rung;
use surefoot_mechanics::integrators::Method;
use surefoot_multibody::Stops;
use surefoot_sim::closed_loop::{Outcome, Run, Scalar, bare_controller, run};
use surefoot_sim::plant::{Additions, RobotModel, Variational};
use surefoot_sim::record::Sample;
use surefoot_sim::scene::{
    AnyScene, JointStops, LUMPED_DEVIATION_M, ModelChoice, Scene, TorquesFrom, load, parse,
};

const SCENES: [&str; 5] = [
    "experiment-1",
    "experiment-1-pushes",
    "experiment-1-welded",
    "experiment-2",
    "experiment-2-welded",
];

fn play(scene: &Scene, model: ModelChoice) -> Run {
    let scene = Scene { model, ..scene.clone() };
    scene.check().expect("a valid scene");
    let run = run(&scene, bare_controller(&scene, Scalar::F64).as_mut(), &mut |_| {});
    assert_eq!(run.outcome, Outcome::Balanced, "{:?}", run.failure);
    run
}

/// Largest difference of a quantity over both records.
fn apart(a: &Run, b: &Run, of: impl Fn(&Sample, &Sample) -> f64) -> f64 {
    assert_eq!(a.samples.len(), b.samples.len());
    a.samples.iter().zip(&b.samples).map(|(a, b)| of(a, b)).fold(0.0, f64::max)
}

fn largest(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// The statement by which `auto` chooses: the central body stays this close in every built-in scene and in both
/// readings of the first instant. Its orientation, the joints and the peaks of torques are close as well.
#[test]
fn the_lumped_biped_stays_as_close_as_stated() {
    for name in SCENES {
        for from in [TorquesFrom::Start, TorquesFrom::TouchDown] {
            let mut scene = load(name).expect("a built-in scene");
            // Welded feet touch nothing.
            if name.ends_with("welded") && from == TorquesFrom::TouchDown {
                continue;
            }
            scene.controller.torques_from = from;
            let full = play(&scene, ModelChoice::Full);
            let lumped = play(&scene, ModelChoice::Lumped);
            let place = |s: &Sample| Vector3::new(s.positions[0], s.positions[1], s.positions[2]);
            let of_place = apart(&full, &lumped, |a, b| (place(a) - place(b)).norm());
            let turn = |s: &Sample| {
                let [q0, q1, q2, q3] = std::array::from_fn(|i| s.positions[3 + i]);
                Quaternion::from_array([q0, q1, q2, q3])
            };
            let of_turn =
                apart(&full, &lumped, |a, b| 2.0 * turn(a).conjugate().product(turn(b)).v.norm());
            let angles = |s: &Sample| -> [f64; 12] { std::array::from_fn(|i| s.positions[7 + i]) };
            let of_angles = apart(&full, &lumped, |a, b| largest(&angles(a), &angles(b)));
            let of_torques = apart(&full, &lumped, |a, b| largest(&a.torques, &b.torques));
            let of_forces = apart(&full, &lumped, |a, b| largest(&a.foot_forces, &b.foot_forces));
            println!(
                "{name}, {from:?}: {of_place:.1e} m, {of_turn:.1e} rad, joints {of_angles:.1e} rad, \
                 {of_torques:.2} N·m, feet {of_forces:.1} N"
            );
            assert!(of_place < LUMPED_DEVIATION_M, "{name}: {of_place}");
            assert!(of_turn < 1e-4, "{name}: {of_turn}");
            assert!(of_angles < 5e-4, "{name}: {of_angles}");
            // Where a foot lands askew its torques are impacts', which differ for a tick.
            assert!(of_torques < 1.5, "{name}: {of_torques}");
            let peak = |run: &Run| {
                run.samples.iter().flat_map(|s| &s.torques).fold(0.0, |m: f64, t| m.max(t.abs()))
            };
            assert!((peak(&full) / peak(&lumped) - 1.0).abs() < 1e-3, "{name}");
        }
    }
}

/// The smallest model that a scene bears, with the reason for any other.
#[test]
fn auto_takes_the_smallest_model_that_the_scene_bears() {
    let scene = load("experiment-1").expect("a built-in scene");
    let chosen = |change: &dyn Fn(&mut Scene)| {
        let mut scene = scene.clone();
        change(&mut scene);
        scene.check().expect("a valid scene");
        let rung = scene.rung();
        (rung.model, rung.reason)
    };
    assert_eq!(chosen(&|_| {}).0, RobotModel::Lumped);
    assert_eq!(chosen(&|s| s.matters.deviation_m = LUMPED_DEVIATION_M).0, RobotModel::Lumped);
    for (change, word) in [
        (&(|s: &mut Scene| s.model = ModelChoice::Full) as &dyn Fn(&mut Scene), "names it"),
        (&|s| s.matters.deviation_m = 1e-6, "1e-6 m matter"),
        (&|s| s.acting.joint_stops = Some(stops()), "stops need hinges"),
        (
            &|s| {
                s.integrator.name = Method::SemiImplicitEuler;
                s.integrator.step_s = 5e-5;
            },
            "baseline",
        ),
        (&|s| s.initial.legs_mut().expect("legs").left_leg_deg[1] = 80.0, "gimbal lock"),
    ] {
        let (model, reason) = chosen(change);
        assert_eq!(model, RobotModel::Full, "{word}");
        assert!(reason.contains(word), "{reason}");
    }
}

fn stops() -> JointStops {
    let wide = [[-170.0, 170.0]; 6];
    JointStops { left_deg: wide, right_deg: wide, stiffness: 1000.0 }
}

/// A model that cannot play the scene, or a deviation that is none, is bad input with its place; so is asking the
/// plant itself.
#[test]
fn models_that_cannot_be_are_refused() {
    let text = include_str!("../../../sim-host/scenes/experiment-1.toml");
    for (from, to, words) in [
        ("duration_s = 3.0", "duration_s = 3.0\nmodel = \"tiny\"", ["unknown variant", "lumped"]),
        (
            "[integrator]",
            "[matters]\ndeviation_m = -1.0\n[integrator]",
            ["matters.deviation_m", "zero or more"],
        ),
        (
            "duration_s = 3.0\n\n[integrator]\nname = \"variational\"\nstep_s = 2e-3",
            "duration_s = 3.0\nmodel = \"lumped\"\n[integrator]\nname = \"semi-implicit-euler\"\nstep_s = 1e-4",
            ["model", "full or auto"],
        ),
    ] {
        assert!(text.contains(from), "{from}");
        let error = parse("test", &text.replacen(from, to, 1)).expect_err(to).to_string();
        for word in words {
            assert!(error.contains(word), "{to}: {error}");
        }
    }
    let AnyScene::Robot(scene) = parse("test", text).expect("a scene") else { unreachable!() };
    let free = Stops { low: -3.0, high: 3.0, stiffness: 100.0 };
    let additions = Additions {
        model: RobotModel::Lumped,
        stops: Some(vec![free; 12]),
        ..Additions::default()
    };
    let refused = Variational::welded(&scene.robot(), &scene.initial.state(), 1e-3, &additions);
    let error = refused.map(|_| ()).expect_err("hinges are gone").to_string();
    assert!(error.contains("full model"), "{error}");
}

/// Every rung of Experiment 1 is played; each model of a motion solves for no more than the larger one, and a
/// second copy of it changes nothing.
#[test]
fn every_rung_plays_the_motion() {
    let mut scene = load("experiment-1").expect("a built-in scene");
    scene.duration_s = 0.2;
    let rungs = Rung::of(&scene);
    let unknowns: Vec<usize> = rungs
        .iter()
        .map(|rung| {
            let one = rung.play(&scene, NonZeroUsize::MIN).expect("a motion");
            let two = rung.play(&scene, NonZeroUsize::MIN.saturating_add(1)).expect("a motion");
            assert_eq!(one.path, two.path);
            assert!(one.path.len() > 90 && one.steps >= 100);
            one.unknowns
        })
        .collect();
    println!("{rungs:?}: {unknowns:?}");
    assert_eq!(unknowns[1..], [18, 18, 18, 18, 16, 12]);
    assert!(unknowns[0] > 150, "{unknowns:?}");
}

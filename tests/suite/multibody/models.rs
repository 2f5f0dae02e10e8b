//! Models of mechanisms: the smallest by default, any other that the scene bears when it is asked for.

use std::num::NonZeroUsize;
use surefoot_host::parsimony::MechanismRung;
use surefoot_multibody::{NotPlanar, NotSingle};
use surefoot_sim::mechanism::{MechanismModel, NotMerged, StartFailure, run_model, start_model};
use surefoot_sim::scene::{AnyScene, Integrator, MechanismScene, open, parse};

/// Under the method that has several models, whatever is recommended for the scene.
fn scene(name: &str, duration_s: f64) -> MechanismScene {
    let AnyScene::Mechanism(mut scene) = open(name).expect("built in") else { unreachable!() };
    scene.duration_s = duration_s;
    scene.integrator = Integrator::default();
    scene
}

#[test]
fn scenes_are_played_with_the_smallest_model() {
    for (name, model, bodies) in [
        ("hinged-chain", MechanismModel::Planar, 5),
        ("box-drop", MechanismModel::SingleBody, 1),
        ("chain", MechanismModel::Full, 10),
        ("four-bar", MechanismModel::Full, 3),
        ("biped-flight", MechanismModel::Full, 13),
    ] {
        let chosen = start_model(&scene(name, 1.0), None).expect("a start").model.expect("a model");
        println!("{name}: {}: {}", chosen.model, chosen.reason);
        assert_eq!((chosen.model, chosen.bodies), (model, bodies), "{name}");
    }
    assert_eq!(start_model(&scene("rigid-body", 1.0), None).expect("a start").model, None);
}

/// One body in a plane: in space where it touches nothing, and knows its way beforehand; in its plane on a floor.
#[test]
fn one_free_body_is_played_as_what_costs_least() {
    let text = |floor: &str, points: &str| {
        format!(
            r#"
description = "a box thrown about its first axis"
duration_s = 1.0
[integrator]
name = "variational"
step_s = 1e-3
[mechanism]
kind = "multibody"
gravity_m_s2 = 9.81
{floor}
[[mechanism.bodies]]
name = "box"
mass_kg = 1.0
inertia_kg_m2 = [0.01, 0.03, 0.02]
center_m = [0.0, 0.0, 0.3]
joint = {{ kind = "floating", velocity_m_s = [1.0, 0.0, 0.0], angular_velocity_rad_s = [0.0, 4.0, 0.0] }}
{points}
"#
        )
    };
    let floor = "floor = { normal_stiffness = 7e4, normal_damping = 2e2, tangential_stiffness = 7e4, \
                 tangential_damping = 2e2, static_friction = 0.4, dynamic_friction = 0.4, \
                 zero_velocity_threshold = 1e-3 }";
    let pair = "contact_points_m = [[0.1, 0.2, -0.1], [0.1, -0.2, -0.1]]";
    let one = "contact_points_m = [[0.1, 0.2, -0.1]]";
    for (text, model) in [
        (text("", ""), MechanismModel::SingleBody),
        (text(floor, pair), MechanismModel::Planar),
        (text(floor, one), MechanismModel::SingleBody),
    ] {
        let AnyScene::Mechanism(scene) = parse("test", &text).expect("a scene") else {
            unreachable!()
        };
        let run = run_model(&scene, None, None, &mut |_| {}).expect("a run");
        assert!(run.failure.is_none(), "{:?}", run.failure);
        let chosen = run.model.expect("a model");
        assert_eq!(chosen.model, model, "{}", chosen.reason);
    }
}

/// All models tell the same motion of all bodies, the same energy and the same touch-downs.
#[test]
fn models_that_are_asked_for_tell_the_same() {
    use MechanismModel::{Full, Merged, Planar, SingleBody};
    for (name, models) in [("hinged-chain", [Merged, Planar]), ("box-drop", [SingleBody; 2])] {
        let scene = scene(name, 0.8);
        let play = |model| run_model(&scene, Some(model), None, &mut |_| {}).expect("a run");
        let full = play(Full);
        assert_eq!(full.model.as_ref().map(|chosen| chosen.model), Some(Full));
        for model in models {
            let other = play(model);
            assert_eq!(other.model.as_ref().map(|chosen| chosen.model), Some(model));
            let mut worst = 0.0_f64;
            for (a, b) in full.samples.iter().zip(&other.samples) {
                let each = a.configuration.iter().zip(&b.configuration);
                worst = each.fold(worst, |m, (a, b)| m.max((a - b).abs()));
                assert!(
                    (a.energy - b.energy).abs() < 1e-7 * a.energy.abs(),
                    "{name}, {}",
                    a.time_s
                );
            }
            println!("{name}, {model}: {worst:.1e}");
            assert!(worst < 1e-9, "{name}, {model}: {worst}");
            assert_eq!(full.events, other.events, "{name}, {model}");
            assert_eq!(full.forecast_s.is_some(), other.forecast_s.is_some(), "{name}, {model}");
        }
    }
}

#[test]
fn what_a_scene_does_not_bear_is_told() {
    let refused =
        |name: &str, model| start_model(&scene(name, 1.0), Some(model)).err().expect("a failure");
    assert_eq!(
        refused("chain", MechanismModel::Planar),
        StartFailure::NotPlanar(NotPlanar::Axis { link: 1 })
    );
    assert_eq!(
        refused("four-bar", MechanismModel::Planar),
        StartFailure::NotPlanar(NotPlanar::Loops)
    );
    assert_eq!(
        refused("chain", MechanismModel::Merged),
        StartFailure::NotMerged(NotMerged::NothingFixed)
    );
    assert_eq!(
        refused("chain", MechanismModel::SingleBody),
        StartFailure::NotSingle(NotSingle::Links { links: 10 })
    );
    assert_eq!(refused("rigid-body", MechanismModel::Full), StartFailure::OneModel);
}

/// A run that one model has saved is no start for another.
#[test]
fn a_saved_run_belongs_to_its_model() {
    let scene = scene("hinged-chain", 0.05);
    let play = |model| run_model(&scene, Some(model), None, &mut |_| {}).expect("a run");
    let saved = play(MechanismModel::Planar).saved.expect("saved");
    let other = run_model(&scene, Some(MechanismModel::Merged), Some(&saved), &mut |_| {});
    assert!(other.is_err());
}

/// The ladder of the chart: all rungs that a scene bears, and the same motion on each.
#[test]
fn rungs_are_one_motion() {
    use MechanismRung::{JointCoordinates, Merged, Multipliers, Planar, SingleBody};
    for (name, rungs) in [
        ("hinged-chain", vec![Multipliers, JointCoordinates, Merged, Planar]),
        ("box-drop", vec![JointCoordinates, SingleBody]),
        ("four-bar", vec![JointCoordinates]),
    ] {
        let scene = scene(name, 0.2);
        assert_eq!(MechanismRung::of(&scene), rungs, "{name}");
        let play = |rung: &MechanismRung| rung.play(&scene, NonZeroUsize::MIN).expect("a motion");
        let reference = play(&JointCoordinates);
        for rung in &rungs {
            let played = play(rung);
            let worst = reference
                .path
                .iter()
                .zip(&played.path)
                .fold(0.0_f64, |m, (a, b)| (0..3).fold(m, |m, i| m.max((a[i] - b[i]).abs())));
            println!("{name}, {rung:?}: {worst:.1e}, {} unknowns", played.unknowns);
            assert_eq!(reference.path.len(), played.path.len());
            assert!(worst < 1e-9, "{name}, {rung:?}: {worst}");
        }
    }
}

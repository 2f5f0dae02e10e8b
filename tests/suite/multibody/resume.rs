//! A run that is stopped and taken up again makes the same bits as one that is not.

use surefoot_sim::closed_loop::{self, Scalar};
use surefoot_sim::mechanism;
use surefoot_sim::record::SavedRun;
use surefoot_sim::scene::{AnyScene, Integrator, MechanismScene, open};

/// By way of the file.
fn written_and_read(saved: Option<SavedRun>, name: &str) -> SavedRun {
    let folder = std::env::temp_dir().join(format!("surefoot-resume-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let path = folder.join(format!("{name}.json"));
    let saved = saved.expect("a run that can be saved");
    saved.write(&path).expect("written");
    let read = SavedRun::read(&path).expect("read");
    assert_eq!(read, saved);
    std::fs::remove_dir_all(&folder).expect("removed");
    read
}

/// Under the method that can be taken up again, whatever is recommended for the scene.
fn mechanism_scene(name: &str) -> MechanismScene {
    let AnyScene::Mechanism(mut scene) = open(name).expect("built in") else { unreachable!() };
    scene.integrator = Integrator::default();
    scene
}

#[test]
fn mechanisms_go_on_to_the_same_bits() {
    for name in ["box-drop", "four-bar", "biped-flight", "chain", "hinged-chain"] {
        let mut scene = mechanism_scene(name);
        scene.duration_s = 1.0;
        let whole = mechanism::run(&scene, &mut |_| {}).expect("a run");
        // In the midst of the box's impacts.
        scene.duration_s = 0.437;
        let first = mechanism::run(&scene, &mut |_| {}).expect("a run");
        let saved = written_and_read(first.saved, name);
        scene.duration_s = 1.0;
        let second = mechanism::run_from(&scene, Some(&saved), &mut |_| {}).expect("a run");
        let (a, b) = (whole.samples.last(), second.samples.last());
        assert_eq!(a.expect("samples"), b.expect("samples"), "{name}");
        assert_eq!(whole.saved, second.saved, "{name}");
        let events = [first.events, second.events].concat();
        assert_eq!(whole.events, events, "{name}");
    }
}

#[test]
fn controlled_robots_go_on_to_the_same_bits() {
    for name in ["experiment-1", "experiment-1-welded", "experiment-2"] {
        let AnyScene::Robot(mut scene) = open(name).expect("built in") else { unreachable!() };
        let run = |scene: &_, from: Option<&SavedRun>| {
            let mut controller = closed_loop::controller(scene, Scalar::F64);
            let run = closed_loop::run_from(scene, controller.as_mut(), from, &mut |_| {});
            assert!(run.failure.is_none(), "{:?}", run.failure);
            run
        };
        scene.duration_s = 0.3;
        let whole = run(&scene, None);
        // The supervisor remembers too, most of all amid the impacts of the first ticks.
        for first in [1, 2, 3, 4, 50] {
            scene.duration_s = f64::from(first) * 2e-3;
            let saved = written_and_read(run(&scene, None).saved, name);
            scene.duration_s = 0.3;
            let second = run(&scene, Some(&saved));
            let rest = &whole.samples[first as usize..];
            for (a, b) in rest.iter().zip(&second.samples) {
                assert!(a == b, "{name}, at {} s", a.time_s);
            }
            assert_eq!(rest.len(), second.samples.len());
            assert_eq!(whole.saved, second.saved, "{name}");
        }
    }
}

#[test]
fn what_belongs_to_another_run_is_refused() {
    let saved = |name: &str| {
        let mut scene = mechanism_scene(name);
        scene.duration_s = 0.01;
        let run = mechanism::run(&scene, &mut |_| {}).expect("a run");
        (scene, run.saved.expect("saved"))
    };
    let (chain, of_chain) = saved("chain");
    let (_, of_box) = saved("box-drop");
    let refused = |scene: &MechanismScene, saved: &SavedRun| {
        let run = mechanism::run_from(scene, Some(saved), &mut |_| {});
        run.expect_err("another motion").to_string()
    };
    assert!(refused(&chain, &of_box).contains("mechanism"));
    let mut slower = chain.clone();
    slower.integrator.step_s *= 2.0;
    let difference = refused(&slower, &of_chain);
    assert!(difference.contains("integrator.step_s = 0.001, not 0.002"), "{difference}");
    // A scene that says the same under another name is the same motion.
    let mut renamed = chain;
    (renamed.name, renamed.description) = ("another".into(), "the same chain".into());
    mechanism::run_from(&renamed, Some(&of_chain), &mut |_| {}).expect("the same motion");
    let missing = SavedRun::read(std::path::Path::new("no/such/file.json")).expect_err("no file");
    assert!(missing.contains("no/such/file.json"), "{missing}");
}

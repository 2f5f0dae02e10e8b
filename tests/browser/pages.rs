//! Pages to look at.

use crate::chromium::folder;
use std::path::PathBuf;
use std::sync::OnceLock;
use surefoot_host::report::{MechanismReport, Report, mechanism_page, page};
use surefoot_multibody::contact::Floor;
use surefoot_sim::closed_loop::{Run, Scalar, controller, run};
use surefoot_sim::mechanism;
use surefoot_sim::plant::BlockSample;
use surefoot_sim::record::{Event, EventKind, MechanismRecord};
use surefoot_sim::scene::{AnyScene, Block, Feet, Scene, StruckBox, TorquesFrom, load, open};

/// Experiment 1, written once.
pub fn experiment_1() -> &'static PathBuf {
    static PAGE: OnceLock<PathBuf> = OnceLock::new();
    PAGE.get_or_init(|| {
        let (scene, run) = made();
        written("experiment-1", &scene, &run)
    })
}

/// The same with a block that flies by, whatever the plant makes of it, and with many events: what the
/// page makes of a record that has all there can be.
pub fn with_a_block() -> &'static PathBuf {
    static PAGE: OnceLock<PathBuf> = OnceLock::new();
    PAGE.get_or_init(|| {
        let (mut scene, mut run) = made();
        scene.block = Some(Block {
            mass_kg: 1.8,
            size_m: [0.12, 0.12, 0.12],
            position_m: [0.5, 0.1, 1.2],
            velocity_mps: [-4.5, 0.0, 0.2],
            strikes: StruckBox {
                size_m: [0.256, 0.299, 0.597],
                offset_m: [0.0; 3],
                surface: floor(&scene),
            },
        });
        for sample in &mut run.samples {
            let t = sample.time_s;
            let z = 1.2 + 0.2 * t - 4.905 * t * t;
            let force = if (0.08..0.1).contains(&t) { [600.0, 0.0, 0.0] } else { [0.0; 3] };
            let pose = [0.5 - 4.5 * t.min(0.08), -0.6, z.max(0.06), 1.0, 0.0, 0.0, 0.0];
            sample.block = Some(BlockSample { pose, force });
        }
        let event = |time_s: f64, kind: EventKind, place: &str| Event {
            time_s,
            kind,
            place: place.to_owned(),
        };
        run.events.extend([
            event(0.08, EventKind::Strike, "central body"),
            event(0.09, EventKind::StrikeEnd, "central body"),
            event(0.13, EventKind::HeelOff, "left foot"),
            event(0.14, EventKind::HeelOff, "right foot"),
            event(0.36, EventKind::HeelDown, "right foot"),
            event(0.38, EventKind::HeelDown, "left foot"),
        ]);
        written("with-a-block", &scene, &run)
    })
}

/// A second of mechanisms that differ in what they have: hanging rods, a loop, a box on a floor, point masses, one body.
pub fn mechanisms() -> &'static [(&'static str, PathBuf)] {
    static PAGES: OnceLock<Vec<(&str, PathBuf)>> = OnceLock::new();
    PAGES.get_or_init(|| {
        let names = ["chain", "four-bar", "box-drop", "n-pendulum", "rigid-body"];
        names.map(|name| (name, mechanism_of(name))).to_vec()
    })
}

fn mechanism_of(name: &str) -> PathBuf {
    let AnyScene::Mechanism(mut scene) = open(name).expect("a built-in scene") else {
        panic!("{name} is a mechanism")
    };
    scene.duration_s = 1.0;
    // It begins at rest, close to an equilibrium.
    if name == "four-bar" {
        scene.duration_s = 7.5;
    }
    let run = mechanism::run(&scene, &mut |_| {}).expect("a start");
    let record = MechanismRecord::new(&scene.mechanism, &run.samples).expect("as it was run");
    let report = MechanismReport {
        scene: &scene,
        reason: "named by the scene",
        warnings: &[],
        run: &run,
        record: &record,
        advice: "",
    };
    let path = folder(name).join("report.html");
    std::fs::write(&path, mechanism_page(&report).expect("a page")).expect("writable");
    path
}

fn made() -> (Scene, Run) {
    let mut scene = load("experiment-1").expect("a built-in scene");
    scene.controller.torques_from = TorquesFrom::TouchDown;
    let run = run(&scene, controller(&scene, Scalar::F64).as_mut(), &mut |_| {});
    assert!(run.failure.is_none(), "{:?}", run.failure);
    (scene, run)
}

fn floor(scene: &Scene) -> Floor {
    match scene.feet {
        Feet::Floor { floor, .. } => floor,
        Feet::Welded {} => panic!("experiment 1 has a floor"),
    }
}

fn written(name: &str, scene: &Scene, run: &Run) -> PathBuf {
    let report = Report { scene, controller: "f64, on the host", run, other: None };
    let path = folder(name).join("report.html");
    std::fs::write(&path, page(&report).expect("a page")).expect("writable");
    path
}

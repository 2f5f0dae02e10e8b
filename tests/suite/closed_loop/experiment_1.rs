//! Experiment 1 on the floor.

use surefoot_mechanics::integrators::Method;
use surefoot_sim::closed_loop::{Outcome, Peaks, Run, Scalar, controller, run};
use surefoot_sim::record::EventKind;
use surefoot_sim::scene::{Feet, Integrator, Outline, Scene, TorquesFrom, Workspace, load};

fn play(change: impl FnOnce(&mut Scene), scalar: Scalar) -> Run {
    let mut scene = load("experiment-1").expect("a built-in scene");
    change(&mut scene);
    scene.check().expect("a valid scene");
    run(&scene, controller(&scene, scalar).as_mut(), &mut |_| {})
}

pub(super) fn assert_balanced(run: &Run) {
    assert_eq!(run.outcome, Outcome::Balanced, "{:?}", run.failure);
    let last = run.samples.last().expect("samples");
    assert!(last.error_distance() < 1e-3);
    assert!(last.error_angle() < 0.1_f64.to_radians());
}

/// The literal reading: figures calculated by hand from the printed initial state, to 0.5 %.
#[test]
fn torques_from_the_start() {
    let run = play(|_| {}, Scalar::F64);
    assert_balanced(&run);
    let first = &run.samples[0];
    for (ours, expected) in [
        (first.desired_wrench[2], 1359.5),
        (first.desired_wrench[4], -36.8),
        (first.torques[9], 152.3),
        (first.torques[3], 152.0),
    ] {
        assert!((ours / expected - 1.0).abs() < 5e-3, "{ours} against {expected}");
    }
    // At rest the world-frame force carries the weight that the feet do not.
    let last = run.samples.last().expect("samples");
    assert!((last.desired_wrench[2] - 584.0).abs() < 1.0);
}

/// Torques from touch-down approach the printed 1687 N, −49 N·m, 192 N·m.
#[test]
fn torques_from_touch_down() {
    let run = play(|s| s.controller.torques_from = TorquesFrom::TouchDown, Scalar::F64);
    assert_balanced(&run);
    let down = run.events.iter().find(|e| e.kind == EventKind::TouchDown).expect("a landing");
    // The feet fall 4.6 mm: √(2 · 0.0046 / 9.81) = 0.0306 s; an event has the time of its step's end.
    assert!((0.0306..0.0306 + 2e-3).contains(&down.time_s), "{}", down.time_s);
    let peaks = Peaks::of(&run.samples).expect("samples");
    for (ours, printed) in [
        (peaks.force_z.value, 1687.0),
        (peaks.torque[1].value, -49.0),
        (peaks.joints[9].value, 192.0),
    ] {
        assert!((ours / printed - 1.0).abs() < 0.04, "{ours} against {printed}");
    }
}

#[test]
fn single_precision_balances_and_stays_close_to_double() {
    let single = play(|_| {}, Scalar::F32);
    let double = play(|_| {}, Scalar::F64);
    assert_balanced(&single);
    for (a, b) in single.samples.iter().zip(&double.samples) {
        for (x, y) in a.torques.iter().zip(&b.torques) {
            assert!((x - y).abs() < 0.5, "at {} s: {x} against {y} N·m", a.time_s);
        }
    }
}

#[test]
fn every_sole_and_the_printed_form_balance() {
    for outline in [Outline::M, Outline::R] {
        let run = play(
            |scene| {
                if let Feet::Floor { outline: sole, .. } = &mut scene.feet {
                    *sole = Some(outline);
                }
            },
            Scalar::F64,
        );
        assert_balanced(&run);
    }
    assert_balanced(&play(|s| s.controller.workspace = Workspace::BigBase(1e6), Scalar::F64));
}

/// The run is a solution, not an artefact of its step: halving it twice moves the body by some
/// micrometres.
#[test]
fn the_motion_converges_with_the_step() {
    let height = |step: f64| {
        let run = play(|s| s.integrator.step_s = step, Scalar::F64);
        run.samples[150].positions[2]
    };
    let [a, b, c] = [1e-3, 5e-4, 2.5e-4].map(height);
    println!("z(0.3 s): {a} {b} {c}");
    assert!((a - b).abs() < 2e-5 && (b - c).abs() < 1e-5, "{a} {b} {c}");
}

/// Another plant, which shares nothing but the floor's law with the default one, plays the same run:
/// explicit, at a twentieth of the step. (At the scene's 2 ms one transient peak at touch-down, the torque
/// about y, is 2 % lower.)
#[test]
fn the_baseline_plant_agrees() {
    for from in [TorquesFrom::Start, TorquesFrom::TouchDown] {
        let ours = play(
            |s| {
                s.controller.torques_from = from;
                s.integrator.step_s = 1e-3;
            },
            Scalar::F64,
        );
        let explicit = Integrator { name: Method::SemiImplicitEuler, step_s: 5e-5 };
        let baseline = play(
            |s| {
                s.controller.torques_from = from;
                s.integrator = explicit;
            },
            Scalar::F64,
        );
        assert_balanced(&ours);
        assert_balanced(&baseline);
        let mut worst = [0.0_f64; 2];
        for (a, b) in ours.samples.iter().zip(&baseline.samples) {
            for i in 0..19 {
                let part = usize::from(i >= 3);
                worst[part] = worst[part].max((a.positions[i] - b.positions[i]).abs());
            }
        }
        println!(
            "{from:?}: {:.1e} m, {:.1e} rad; {} and {} steps",
            worst[0], worst[1], ours.steps, baseline.steps
        );
        assert!(worst[0] < 2e-3 && worst[1] < 1e-2, "{worst:?}");
        let (a, b) = (Peaks::of(&ours.samples), Peaks::of(&baseline.samples));
        let (a, b) = (a.expect("samples"), b.expect("samples"));
        for (x, y) in [
            (a.force_z.value, b.force_z.value),
            (a.torque[1].value, b.torque[1].value),
            (a.joints[9].value, b.joints[9].value),
        ] {
            assert!((x / y - 1.0).abs() < 5e-3, "{x} against {y}");
        }
    }
}

/// Beyond the stability limit the run ends with a reason, and says a smaller step.
#[test]
fn a_step_too_large_is_a_failure_with_its_reason() {
    let explicit = Integrator { name: Method::SemiImplicitEuler, step_s: 1e-3 };
    let run = play(|s| s.integrator = explicit, Scalar::F64);
    let failure = run.failure.expect("the floor is too stiff for this step");
    assert!(["stopped", "step"].contains(&failure.kind), "{failure:?}");
    assert!(!failure.advice.is_empty());
    for sample in &run.samples {
        assert!(sample.torques.iter().all(|x| x.is_finite()));
    }
}

#[test]
fn a_straight_knee_is_a_fault_with_its_reason() {
    let run = play(
        |scene| {
            let start = scene.initial.legs_mut().expect("legs");
            start.position_m[2] = 1.24;
            start.turn_deg = 0.0;
            start.left_leg_deg = [0.0; 6];
            start.right_leg_deg = [0.0; 6];
            scene.set_point.position_m = [0.0, 0.0, 1.1];
            scene.set_point.orientation = [1.0, 0.0, 0.0, 0.0];
        },
        Scalar::F64,
    );
    assert_eq!(run.outcome, Outcome::Stopped);
    let failure = run.failure.expect("a fault");
    assert_eq!(failure.kind, "stopped");
    assert!(failure.place.contains("singular"), "{failure:?}");
}

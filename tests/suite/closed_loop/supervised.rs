//! The supervised loop under sensors and motors as robots have them, and in both experiments: counted encoders,
//! noise, impacts and a thrown block are no faults to it.

use surefoot_sim::closed_loop::{self, Outcome, Scalar, controller};
use surefoot_sim::scene::{Feet, Outline, Scene, Sensing, TorquesFrom, load};

/// Both experiments on all soles, and on feet that are held, in steps from 2 ms to 20 µs, with torques from the
/// start and from touch-down, in both precisions: nothing stops them, and all arrive.
#[test]
fn experiments_run_without_a_false_stop() {
    let mut runs = 0;
    let mut play = |scene: &Scene, scalar: Scalar, what: &str| {
        let run = closed_loop::run(scene, controller(scene, scalar).as_mut(), &mut |_| {});
        assert_eq!((run.stop, run.failure), (None, None), "{what}, {scalar:?}");
        let is_whole = scene.duration_s > 2.0;
        assert!(!is_whole || run.outcome == Outcome::Balanced, "{what}, {scalar:?}");
        runs += 1;
    };
    for name in ["experiment-1", "experiment-2", "experiment-1-welded", "experiment-2-welded"] {
        // The shortest step for the time in which all impacts are.
        for (step_s, duration_s) in [(2e-3, 3.0), (5e-4, 3.0), (2e-5, 0.8)] {
            for from in [TorquesFrom::Start, TorquesFrom::TouchDown] {
                for sole in [Outline::A, Outline::R, Outline::M] {
                    let mut scene = load(name).expect("built in");
                    (scene.integrator.step_s, scene.duration_s) = (step_s, duration_s);
                    match &mut scene.feet {
                        Feet::Floor { outline, .. } => *outline = Some(sole),
                        Feet::Welded {} if sole != Outline::A || from != TorquesFrom::Start => {
                            continue;
                        }
                        Feet::Welded {} => {}
                    }
                    scene.controller.torques_from = from;
                    let what = format!("{name}, sole {sole:?}, {step_s} s, {from:?}");
                    play(&scene, Scalar::F64, &what);
                    if step_s > 1e-4 {
                        play(&scene, Scalar::F32, &what);
                    }
                }
            }
        }
    }
    // Slower and faster ticks than those that the limits were measured at.
    for (rate_hz, step_s) in
        [(1000.0, 5e-4), (250.0, 2e-3), (250.0, 5e-4), (125.0, 2e-3), (50.0, 2e-3)]
    {
        for sole in [Outline::A, Outline::R, Outline::M] {
            let mut scene = load("experiment-1").expect("built in");
            (scene.integrator.step_s, scene.controller.rate_hz) = (step_s, rate_hz);
            if let Feet::Floor { outline, .. } = &mut scene.feet {
                *outline = Some(sole);
            }
            play(&scene, Scalar::F32, &format!("experiment-1, sole {sole:?}, {rate_hz} Hz"));
        }
    }
    println!("{runs} runs without a stop");
}

#[test]
fn the_supervisor_takes_counts_and_noise_for_what_they_are() {
    for bits in [12, 14, 16] {
        let mut scene = load("experiment-1").expect("built in");
        scene.sensing = Sensing {
            encoder_counts: 1 << bits,
            gyroscope_noise: 1e-4,
            accelerometer_noise: 1e-3,
            ..Sensing::default()
        };
        scene.acting.delay_s = 1e-3;
        let run = closed_loop::run(&scene, controller(&scene, Scalar::F32).as_mut(), &mut |_| {});
        assert_eq!(run.failure, None, "{bits} bits");
        let last = run.samples.last().expect("samples");
        let degrees = last.error_angle().to_degrees();
        println!("{bits} bits: {:.3} mm, {degrees:.4}°", 1e3 * last.error_distance());
        assert!(last.error_distance() < 3e-3 && degrees < 0.3);
    }
}

/// Encoders that are too coarse to tell rates from noise make the loop fail, and it says of what.
#[test]
fn far_too_coarse_encoders_end_in_a_failure_with_its_reason() {
    let mut scene = load("experiment-1").expect("built in");
    scene.sensing.encoder_counts = 64;
    let run = closed_loop::run(&scene, controller(&scene, Scalar::F32).as_mut(), &mut |_| {});
    let failure = run.failure.expect("rates in steps of 50 rad/s are none");
    println!("{failure:?}");
    assert!(failure.kind == "stopped", "{failure:?}");
    assert!(failure.advice.contains("perhaps better ones"));
}

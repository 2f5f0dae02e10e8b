//! A robot that carries what its controller does not know, by its own sensors.

use surefoot_sim::closed_loop::{self, RestError, Run, Scalar, controller, rest_error};
use surefoot_sim::scene::{Disturbance, Scene, StateSource, load};

fn play(scene: &Scene, scalar: Scalar) -> Run {
    closed_loop::run(scene, controller(scene, scalar).as_mut(), &mut |_| {})
}

fn at_end(scene: &Scene, run: &Run) -> RestError {
    let last = run.samples.last().expect("samples");
    rest_error(scene, last).expect("links of the model")
}

fn off(rest: &RestError) -> f64 {
    rest.center_of_mass[0].hypot(rest.center_of_mass[1])
}

/// The built-in scene, f32: 20 kg on the central body, standard biases.
#[test]
fn a_load_is_carried_by_sensors_alone() {
    let scene = load("stand-loaded").expect("built in");
    let run = play(&scene, Scalar::F32);
    let rest = at_end(&scene, &run);
    println!("{:?} {rest:?}", run.outcome);
    assert!(run.failure.is_none());
    assert!(off(&rest) < 2e-3 && rest.tilt < 0.4_f64.to_radians(), "{rest:?}");
}

/// With the true state; without the observer the load leaves its mark. A run that is taken up again has the same bits.
#[test]
fn a_load_is_carried_and_a_run_goes_on() {
    let mut scene = load("stand-loaded").expect("built in");
    scene.sensing = Default::default();
    scene.sensing.state = StateSource::Noise;
    scene.duration_s = 4.0;
    let run = play(&scene, Scalar::F64);
    let rest = at_end(&scene, &run);
    println!("{rest:?}");
    let mut first = scene.clone();
    first.duration_s = 0.7;
    let saved = play(&first, Scalar::F64).saved.expect("on its feet");
    assert!(!saved.observer.is_empty(), "it has observed");
    let mut second = scene.clone();
    second.duration_s = 1.0;
    let mut again = controller(&second, Scalar::F64);
    let later = closed_loop::run_from(&second, again.as_mut(), Some(&saved), &mut |_| {});
    let whole = &run.samples[350..=500];
    assert_eq!(later.samples.len(), whole.len());
    assert!(later.samples.iter().zip(whole).all(|(a, b)| a.positions == b.positions));

    scene.controller.disturbance = Disturbance::Ignored;
    let ignored = at_end(&scene, &play(&scene, Scalar::F64));
    println!("{ignored:?}");
    assert!(off(&rest) < 1e-3 && rest.tilt < 0.1_f64.to_radians(), "{rest:?}");
    assert!(off(&ignored) > 5e-3, "{ignored:?}");
}

//! The state estimator in the loop: what the controller sees is what inertial sensor, encoders and switches tell.

use surefoot_sim::closed_loop::{self, Run, Scalar, controller};
use surefoot_sim::record::{EstimateErrors, WorstErrors};
use surefoot_sim::scene::{Push, Scene, Sensing, StateSource, load};

/// An estimate by sensors that are exact but for inaudible noise.
fn exact() -> Sensing {
    Sensing { state: StateSource::Estimate, ..Sensing::default() }
}

/// The standard biases of the reference, 16 bits, noise of an industrial sensor.
fn standard() -> Sensing {
    Sensing {
        encoder_counts: 1 << 16,
        gyroscope_noise: 1e-4,
        accelerometer_noise: 1e-3,
        seed: 1,
        gyroscope_bias: [0.01, -0.01, 0.01],
        accelerometer_bias: [0.1, -0.1, 0.1],
        ..exact()
    }
}

fn stand(sensing: Sensing) -> Scene {
    let scene = Scene { sensing, ..load("stand").expect("built in") };
    scene.check().expect("a valid scene");
    scene
}

fn play(scene: &Scene) -> Run {
    closed_loop::run(scene, controller(scene, Scalar::F64).as_mut(), &mut |_| {})
}

fn errors(run: &Run) -> WorstErrors {
    assert!(run.failure.is_none(), "{:?}", run.failure);
    let tally = run.estimate.as_ref().expect("an estimator");
    assert!(tally.first.is_none() && tally.feet_made_anew == 0, "{tally:?}");
    WorstErrors::of(&run.samples).expect("an estimator")
}

/// Nothing but the method's own errors: means over a tick, feet that rock.
#[test]
fn exact_sensors_give_the_truth_back() {
    let WorstErrors { last, worst } = errors(&play(&stand(exact())));
    println!("{last:?} {worst:?}");
    assert!(worst.position_error_m < 1e-3 && last.position_error_m < 1e-3, "{worst:?}");
    assert!(worst.tilt_error_rad < 0.05_f64.to_radians(), "{worst:?}");
    // 6.7 mm/s as the feet land.
    assert!(worst.velocity_error_m_s < 8e-3, "{worst:?}");
}

/// The accelerometer's bias across gravity is the tilt, 0.83°, and a set point off by 18 mm; it stands all the same.
#[test]
fn standard_biases_stand() {
    let EstimateErrors { tilt_error_rad, position_error_m, heading_error_rad, .. } =
        errors(&play(&stand(standard()))).last;
    let bias = (0.1 * 2_f64.sqrt() / 9.81).atan();
    println!("{tilt_error_rad} {bias} {position_error_m} {heading_error_rad}");
    assert!((tilt_error_rad - bias).abs() < 0.1_f64.to_radians(), "{tilt_error_rad}");
    assert!(position_error_m < 0.025 && heading_error_rad < 1e-3, "{position_error_m}");
}

/// By exact sensors it takes nine tenths of the pushes that it takes by the truth. With standard biases it leans back
/// and to a side by 2 cm: it takes more backwards, and four fifths forwards and to that side.
#[test]
fn pushes_are_survived() {
    for (sensing, share) in [(exact(), 0.9), (standard(), 0.75)] {
        for (limit, degrees) in [(23.0, 180.0_f64), (36.0, 90.0), (32.0, 0.0)] {
            let mut scene = stand(sensing.clone());
            let (sine, cosine) = degrees.to_radians().sin_cos();
            let force = share * limit / 0.1;
            let force_n = [force * cosine, force * sine, 0.0];
            scene.pushes = vec![Push { at_s: 0.7, duration_s: 0.1, force_n }];
            let run = play(&scene);
            let last = run.samples.last().expect("samples");
            assert!(run.failure.is_none(), "{share} {degrees}°: {:?}", run.failure);
            assert!(last.error_distance() < 0.05, "{degrees}°: {} m", last.error_distance());
        }
    }
}

/// It drops from 5 mm, rises and turns by 15°; and takes the block.
#[test]
fn the_experiments_balance_by_an_estimate() {
    for (name, sensing) in
        [("experiment-1", exact()), ("experiment-1", standard()), ("experiment-2", exact())]
    {
        let scene = Scene { sensing, ..load(name).expect("built in") };
        let run = play(&scene);
        let errors = WorstErrors::of(&run.samples).expect("an estimator");
        println!("{name}: {:?} {errors:?} {:?}", run.failure, run.estimate);
        assert!(run.failure.is_none(), "{name}: {:?}", run.failure);
        assert!(errors.last.position_error_m < 0.03, "{name}: {errors:?}");
    }
}

/// `truth` is the ideal scene, whatever else the table says, to the last bit.
#[test]
fn the_truth_has_no_errors() {
    let short = |sensing| {
        let mut scene = stand(sensing);
        scene.duration_s = 0.2;
        play(&scene).samples
    };
    let truth = Sensing { state: StateSource::Truth, encoder_counts: 64, ..Sensing::default() };
    assert_eq!(short(truth), short(Sensing::default()));
    let seeds = [1, 1, 2].map(|seed| short(Sensing { seed, ..standard() }));
    assert_eq!(seeds[0], seeds[1]);
    assert_ne!(seeds[0], seeds[2]);
}

/// It leaves nothing to go on from, and goes on from nothing.
#[test]
fn an_estimated_run_cannot_be_taken_up_again() {
    let mut scene = stand(Sensing::default());
    scene.duration_s = 0.1;
    let saved = play(&scene).saved.expect("a run of the truth can");
    scene.sensing = standard();
    assert!(play(&scene).saved.is_none());
    scene.duration_s = 0.2;
    let mut controller = controller(&scene, Scalar::F64);
    let run = closed_loop::run_from(&scene, controller.as_mut(), Some(&saved), &mut |_| {});
    let failure = run.failure.expect("a refusal");
    assert!(failure.kind == "resume" && failure.place.contains("estimate"), "{failure:?}");
}

//! Host and target compute the same bits.

use crate::bench::{JOINTS, Torques, target};
use surefoot::balance::StopReason;
use surefoot_sim::closed_loop::firmware::{Emulator, FirmwareController, Target, image_for};
use surefoot_sim::closed_loop::{self, Commanded, ControlFailure, Controller, LimitTally, Scalar};
use surefoot_sim::plant::PlantState;
use surefoot_sim::record::Sample;
use surefoot_sim::scene::{Feet, Outline, Push, Scene, load};

/// The target in the loop, and the host's controller beside it on the same measurements.
struct Twins {
    target: FirmwareController<JOINTS>,
    host: Box<dyn Controller>,
    compared: usize,
}

impl Controller for Twins {
    fn tick(&mut self, state: &PlantState) -> Result<Commanded, ControlFailure> {
        let answer = self.target.tick(state)?;
        let host = self.host.tick(state)?;
        for (host, target) in host.torques.iter().zip(&answer.torques) {
            assert_eq!(host.to_bits(), target.to_bits(), "tick {}", self.compared / 12);
            self.compared += 1;
        }
        assert_eq!(host.desired_wrench, answer.desired_wrench);
        assert_eq!(self.host.stopped(), self.target.stopped());
        Ok(answer)
    }

    fn stopped(&self) -> Option<StopReason> {
        self.target.stopped()
    }

    fn touch(&mut self, time_s: f64, feet: &[bool]) {
        self.target.touch(time_s, feet);
        self.host.touch(time_s, feet);
    }
}

/// Torques and desired wrenches are equal, bit for bit, at every tick; and the costs are bounded.
fn plays_equally(name: &str) {
    let scene = load(name).expect("built in");
    let target = FirmwareController::new(target(), &scene).expect("obeyed");
    let host = closed_loop::controller(&scene, Scalar::F32);
    let mut twins = Twins { target, host, compared: 0 };
    let run = closed_loop::run(&scene, &mut twins, &mut |_| {});
    assert_eq!(run.failure, None);
    assert_eq!(run.outcome, closed_loop::Outcome::Balanced);
    let ticks = (scene.duration_s * scene.controller.rate_hz) as usize + 1;
    assert_eq!(twins.compared, 12 * ticks);

    // The first tick also takes the order to arm, and has no measurement before.
    let costs = &twins.target.tick_costs()[1..];
    let (least, most) = (costs.iter().min().expect("ticks"), costs.iter().max().expect("ticks"));
    let mean = costs.iter().map(|c| f64::from(*c)).sum::<f64>() / costs.len() as f64;
    println!("{name}: {least} to {most} instructions a tick, {mean:.1} on average");
    assert!(f64::from(*most) <= 1.02 * mean, "{most} is above 1.02 · {mean}");
    assert!(*most <= 40_000);
    let status = twins.target.target().status().expect("an answer");
    println!("{name}: stack {} bytes", status.stack_bytes);
    assert!(status.stack_bytes <= 8192);
    assert_eq!((status.overruns, status.telemetry_dropped, status.received.lost), (0, 0, 0));
}

#[test]
#[ignore = "needs the firmware's images: `cargo xtask test --only firmware`"]
fn experiment_1_is_the_same_to_the_last_bit() {
    plays_equally("experiment-1");
}

#[test]
#[ignore = "needs the firmware's images: `cargo xtask test --only firmware`"]
fn experiment_2_is_the_same_to_the_last_bit() {
    plays_equally("experiment-2");
}

#[test]
#[ignore = "needs the firmware's images: `cargo xtask test --only firmware`"]
fn twenty_seconds_of_pushes_are_the_same_to_the_last_bit() {
    plays_equally("experiment-1-pushes");
}

/// Within limits of ground and motors: pushed, and with one that topples it; torques, reports of limits, and stops.
#[test]
#[ignore = "needs the firmware's images: `cargo xtask test --only firmware`"]
fn limited_ticks_are_the_same_to_the_last_bit() {
    for (impulse, degrees) in [(0.0, 0.0), (25.0, 0.0), (35.0, 45.0), (35.0, 90.0), (60.0, 135.0)] {
        let scene = pushed(impulse, degrees);
        let target = FirmwareController::new(target(), &scene).expect("obeyed");
        let host = closed_loop::controller(&scene, Scalar::F32);
        let mut twins = Twins { target, host, compared: 0 };
        let run = closed_loop::run(&scene, &mut twins, &mut |_| {});
        let [host, target] = [twins.host.limits(), twins.target.limits()]
            .map(|limits| limits.map(LimitTally::over_all));
        assert_eq!(host, target);
        let limits = target.expect("a limited distribution");
        let slowest = twins.target.tick_costs().iter().max();
        println!("{impulse} N·s at {degrees}°: {:?} {limits:?} {slowest:?}", run.outcome);
        assert_eq!(limits.active_share > 0.0, impulse > 0.0);
        let status = twins.target.target().status().expect("an answer");
        println!("stack {} bytes", status.stack_bytes);
        assert!(status.stack_bytes <= 10_500 && status.overruns == 0);
    }
}

fn pushed(impulse: f64, degrees: f64) -> Scene {
    let mut scene = load("stand").expect("built in");
    let (sine, cosine) = f64::to_radians(degrees).sin_cos();
    let force = impulse / 0.1;
    let force_n = [force * cosine, force * sine, 0.0];
    scene.pushes = vec![Push { at_s: 0.7, duration_s: 0.1, force_n }];
    scene
}

/// Smaller soles, which are hit harder at the start, do not stop the target; a floor without friction does,
/// and it brakes as the host does.
#[test]
#[ignore = "needs the firmware's images: `cargo xtask test --only firmware`"]
fn supervisors_are_the_same_to_the_last_bit() {
    for (name, sole, friction, is_stopped) in [
        ("experiment-1", Outline::R, 0.3, false),
        ("experiment-1", Outline::M, 0.3, false),
        ("experiment-2", Outline::R, 0.3, false),
        ("experiment-2", Outline::A, 0.0, true),
    ] {
        let mut scene = load(name).expect("built in");
        if let Feet::Floor { outline, floor } = &mut scene.feet {
            *outline = Some(sole);
            (floor.static_friction, floor.dynamic_friction) = (friction, friction);
        }
        let target = FirmwareController::new(target(), &scene).expect("obeyed");
        let host = closed_loop::controller(&scene, Scalar::F32);
        let mut twins = Twins { target, host, compared: 0 };
        let run = closed_loop::run(&scene, &mut twins, &mut |_| {});
        println!("{name}, {sole:?}: {:?} {:?}", run.outcome, run.stop);
        assert_eq!(run.stop.is_some(), is_stopped);
    }
}

/// With a filter on the target that has its own sensors alone, and with an observer: every number of the record, the
/// estimate and what the filter says of it among them.
#[test]
#[ignore = "needs the firmware's images: `cargo xtask test --only firmware`"]
fn estimates_are_the_same_to_the_last_bit() {
    let sensing = load("stand-loaded").expect("built in").sensing;
    for name in ["experiment-1", "experiment-2", "stand", "stand-loaded"] {
        let scene = Scene { sensing: sensing.clone(), ..load(name).expect("built in") };
        let image = image_for(&scene).expect("built");
        let emulator = Emulator::start(&image, &std::env::temp_dir()).expect("it starts");
        let target = Target::connect(emulator).expect("it answers");
        let mut target = FirmwareController::<JOINTS>::new(target, &scene).expect("obeyed");
        let mut host = closed_loop::controller(&scene, Scalar::F32);
        let [on_host, on_target] = [host.as_mut() as &mut dyn Controller, &mut target]
            .map(|controller| closed_loop::run(&scene, controller, &mut |_| {}));
        let status = target.target().status().expect("an answer");
        let costs = target.costs().expect("costs");
        println!("{name}: {:?} {costs:?}, stack {} bytes", on_target.outcome, status.stack_bytes);
        assert_eq!(on_host.failure, on_target.failure);
        assert_eq!(on_host.estimate, on_target.estimate);
        assert!(on_target.estimate.is_some() && on_target.failure.is_none());
        assert_eq!(on_host.samples.len(), on_target.samples.len());
        for (a, b) in on_host.samples.into_iter().zip(on_target.samples) {
            // What the solver's work is, the link does not say.
            let [a, b] = [a, b].map(|sample| Sample { note: None, ..sample });
            assert_eq!(a, b, "{name} at {} s", a.time_s);
        }
        assert!(status.stack_bytes <= 16_384 && status.overruns == 0, "{status:?}");
    }
}

/// The emulator's instruction clock repeats.
#[test]
#[ignore = "needs the firmware's images: `cargo xtask test --only firmware`"]
fn a_second_run_costs_the_same() {
    let run = || -> Vec<Torques> {
        let mut bench = crate::bench::Bench::new(target());
        (0..200).map(|_| bench.tick(|_| {})).collect()
    };
    assert_eq!(run(), run());
}

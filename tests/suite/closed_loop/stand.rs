//! The biped that stands within limits, pushed for a tenth of a second.

use surefoot_sim::closed_loop::{self, Outcome, Run, Scalar, bare_controller, controller};
use surefoot_sim::record::Sample;
use surefoot_sim::scene::{Distribution, Push, Scene, load};

/// Directions, from backwards to the right side to forwards, with the largest impulse that is survived
/// and all below it, N·s (`push_limits 1`).
const LIMITS: [(f64, f64); 5] =
    [(0.0, 32.0), (45.0, 43.0), (90.0, 36.0), (135.0, 30.0), (180.0, 23.0)];

fn pushed(impulse: f64, degrees: f64) -> Scene {
    let mut scene = load("stand").expect("built in");
    let (sine, cosine) = degrees.to_radians().sin_cos();
    let force = impulse / 0.1;
    let force_n = [force * cosine, force * sine, 0.0];
    scene.pushes = vec![Push { at_s: 0.7, duration_s: 0.1, force_n }];
    scene
}

fn play(scene: &Scene, scalar: Scalar) -> Run {
    closed_loop::run(scene, controller(scene, scalar).as_mut(), &mut |_| {})
}

/// On its feet and near the set point at the end; not stopped by its supervisor.
fn survives(run: &Run) -> bool {
    let Some(last) = run.samples.last() else { return false };
    run.failure.is_none() && last.error_distance() < 0.05 && last.error_angle() < 5_f64.to_radians()
}

#[test]
fn pushes_up_to_the_limits_are_survived() {
    for (degrees, limit) in LIMITS {
        for share in [0.3, 0.6, 0.9] {
            for scalar in [Scalar::F64, Scalar::F32] {
                let run = play(&pushed(share * limit, degrees), scalar);
                assert!(survives(&run), "{degrees}°, {share} of {limit}: {:?}", run.failure);
                let limits = run.limits.expect("a limited distribution");
                println!("{degrees}°, {share} of {limit}, {scalar:?}: {limits:?}");
                assert!(share < 0.9 || limits.active_share > 0.1 && limits.worst.is_some());
                // What the work of a tick does not reach, the next one goes on with.
                assert!(limits.unfinished < limits.ticks / 6, "{degrees}°, {share}: {limits:?}");
            }
        }
        let run = play(&pushed(1.1 * limit, degrees), Scalar::F64);
        assert!(!survives(&run), "{degrees}°: more than {limit}");
    }
}

/// No push is lost to the supervisor alone: what it stops does not survive without it either.
#[test]
fn the_supervisor_costs_no_push() {
    for (degrees, limit) in LIMITS {
        let scene = pushed(1.1 * limit, degrees);
        let mut bare = bare_controller(&scene, Scalar::F64);
        let run = closed_loop::run(&scene, bare.as_mut(), &mut |_| {});
        assert!(!survives(&run), "{degrees}°: {limit} N·s and a tenth, without a supervisor");
    }
}

/// Without a push nothing binds once the feet have settled, and the motion is the printed one's.
#[test]
fn standing_is_as_with_the_printed_split() {
    let mut scene = load("stand").expect("built in");
    let limited = play(&scene, Scalar::F64);
    assert_eq!(limited.outcome, Outcome::Balanced);
    assert_eq!(limited.limits.map(|limits| limits.active_share), Some(0.0));
    scene.controller.distribution = Distribution::LeastNorm;
    let printed = play(&scene, Scalar::F64);
    assert_eq!(printed.limits, None);
    // What the limits say of a tick is all that differs.
    let samples = limited.samples.into_iter().map(|sample| Sample { note: None, ..sample });
    assert!(samples.eq(printed.samples));
}

/// The printed split topples at a seventh of the side's limit.
#[test]
fn the_printed_split_topples() {
    let mut scene = pushed(7.0, 90.0);
    scene.controller.distribution = Distribution::LeastNorm;
    assert!(!survives(&play(&scene, Scalar::F64)));
}

/// A run that is saved while limits bind goes on to the same bits.
#[test]
fn a_pushed_run_is_taken_up_again() {
    let scene = pushed(20.0, 90.0);
    let whole = play(&scene, Scalar::F64);
    let mut first = scene.clone();
    first.duration_s = 0.9;
    let saved = play(&first, Scalar::F64).saved.expect("on its feet");
    assert!(!saved.limit_rows.is_empty(), "limits bind");
    let mut again = controller(&scene, Scalar::F64);
    let rest = closed_loop::run_from(&scene, again.as_mut(), Some(&saved), &mut |_| {});
    assert_eq!(rest.samples.last(), whole.samples.last());
}

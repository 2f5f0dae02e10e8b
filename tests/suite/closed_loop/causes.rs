//! Why a run has failed is told from trials: of the step, of the loop.

use surefoot_mechanics::integrators::Method;
use surefoot_sim::closed_loop::{
    Outcome, Remedy, Run, Scalar, StepTrial, bare_controller, controller, explain, run,
};
use surefoot_sim::scene::{Integrator, Scene, load};

fn experiment() -> Scene {
    load("experiment-1").expect("a built-in scene")
}

fn play(scene: &Scene) -> Run {
    run(scene, controller(scene, Scalar::F64).as_mut(), &mut |_| {})
}

fn play_bare(scene: &Scene) -> Run {
    run(scene, bare_controller(scene, Scalar::F64).as_mut(), &mut |_| {})
}

fn explained(scene: &Scene, play: fn(&Scene) -> Run) -> Run {
    let mut run = play(scene);
    explain(scene, &mut run, &mut |scene| Some(play(scene)));
    run
}

/// Ten ticks a second are too few, whatever the step; the rate that is named completes the run.
#[test]
fn a_loop_that_runs_away_is_told_from_a_step_that_is_too_long() {
    let mut slow = experiment();
    slow.controller.rate_hz = 10.0;
    let run = explained(&slow, play_bare);
    let (failure, cause) = (run.failure.expect("a failure"), run.cause.expect("a cause"));
    println!("{}", failure.advice);
    assert!(
        cause.runaway.as_ref().is_some_and(|runaway| runaway.torque_nm.abs() > 1e3),
        "{cause:?}"
    );
    assert!(matches!(cause.steps, StepTrial::SameInstant { .. }), "{cause:?}");
    assert!(failure.advice.contains("runs away") && !failure.advice.contains("a shorter step"));
    let Some(Remedy::Rate { rate_hz }) = cause.remedy else { panic!("{cause:?}") };
    slow.controller.rate_hz = rate_hz;
    assert_eq!(play_bare(&slow).failure, None);
}

/// The supervisor stops the same loop before it runs away; the advice names a rate that completes the run.
#[test]
fn a_stop_by_the_supervisor_is_explained_too() {
    let mut slow = experiment();
    slow.controller.rate_hz = 10.0;
    let run = explained(&slow, play);
    let (failure, cause) = (run.failure.expect("a failure"), run.cause.expect("a cause"));
    println!("{}", failure.advice);
    assert_eq!((run.outcome, &cause.runaway), (Outcome::Stopped, &None));
    let Some(Remedy::Rate { rate_hz }) = cause.remedy else { panic!("{cause:?}") };
    assert!(failure.advice.contains("a control rate of"), "{}", failure.advice);
    slow.controller.rate_hz = rate_hz;
    assert_eq!(play(&slow).failure, None);
}

/// An explicit method on a stiff floor: half the step, or a quarter, completes the run; and that is what is named.
#[test]
fn a_step_that_is_too_long_is_told_from_a_loop_that_runs_away() {
    let mut coarse = experiment();
    coarse.integrator = Integrator { name: Method::SemiImplicitEuler, step_s: 2.5e-4 };
    coarse.duration_s = 0.5;
    let run = explained(&coarse, play);
    let (failure, cause) = (run.failure.expect("a failure"), run.cause.expect("a cause"));
    println!("{}", failure.advice);
    let StepTrial::Completes { step_s } = cause.steps else { panic!("{cause:?}") };
    assert!(step_s < coarse.integrator.step_s && failure.advice.contains("shorter step"));
    coarse.integrator.step_s = step_s;
    assert_eq!(play(&coarse).failure, None);
}

/// A run that completes costs no trials, and has no cause.
#[test]
fn what_does_not_fail_is_not_tried() {
    let scene = experiment();
    let mut run = play(&scene);
    explain(&scene, &mut run, &mut |_| panic!("no trial is due"));
    assert!(run.cause.is_none() && run.outcome != Outcome::Failed);
}

//! Limits of the loop: the search, its cells, how runs fail, and breaking off.

use std::cell::RefCell;
use std::path::PathBuf;
use std::sync::Mutex;
use surefoot::model::robots::biped;
use surefoot_host::stability::loop_limits::{
    Cell, Criterion, Ending, Footing, Found, Ladder, Loop, Manner, Quantity, Store, Survey,
    Tolerance, Trial, play, search,
};
use surefoot_multibody::contact::ContactState;
use surefoot_sim::closed_loop::{Failure, Run};
use surefoot_sim::scene::{Outline, Push, Scene, load};

/// Searches for a limit of a rule; with all values that were tried.
fn found(
    ladder: Ladder,
    tolerance: Tolerance,
    works: impl Fn(f64) -> bool,
) -> (Found<&'static str>, Vec<f64>) {
    let tried = RefCell::new(Vec::new());
    let attempt = |value: f64| -> Result<_, ()> {
        tried.borrow_mut().push(value);
        Ok((!works(value)).then_some("fails"))
    };
    let found = search(ladder, tolerance, attempt).expect("no error");
    (found, tried.into_inner())
}

#[test]
fn a_known_threshold_is_found_to_the_tolerance() {
    let up = Ladder::Geometric { from: 1.0, ratio: 1.25, to: 100.0 };
    let down = Ladder::Geometric { from: 100.0, ratio: 0.8, to: 0.5 };
    let even = Ladder::Arithmetic { from: -1.0, step: 0.7, to: 90.0 };
    for threshold in [1.7, 9.0, 42.0, 88.8] {
        let rises = |x: f64| x <= threshold;
        let falls = |x: f64| x >= threshold;
        for (ladder, tolerance, works) in [
            (up, Tolerance::Relative(0.01), &rises as &dyn Fn(f64) -> bool),
            (even, Tolerance::Absolute(1e-3), &rises),
            (down, Tolerance::Relative(1e-4), &falls),
        ] {
            let Found::Limit { works: good, fails, manner } = found(ladder, tolerance, works).0
            else {
                panic!("{ladder:?}: no limit at {threshold}")
            };
            assert_eq!(manner, "fails");
            assert!(works(good) && !works(fails), "{good} {fails}");
            assert!(tolerance.holds(good, fails), "{good} and {fails} for {threshold}");
        }
    }
}

#[test]
fn ends_without_a_limit_are_told() {
    let ladder = Ladder::Geometric { from: 2.0, ratio: 1.5, to: 9.0 };
    let tolerance = Tolerance::Relative(0.01);
    let (none, tried) = found(ladder, tolerance, |_| true);
    assert_eq!(none, Found::FarEndWorks { to: 9.0 });
    assert_eq!(tried, [2.0, 3.0, 4.5, 6.75, 9.0]);
    let (all, tried) = found(ladder, tolerance, |_| false);
    assert_eq!(all, Found::EasyEndFails { at: 2.0, manner: "fails" });
    assert_eq!(tried, [2.0]);
    let last = found(ladder, tolerance, |x| x < 9.0).0;
    assert!(matches!(last, Found::Limit { fails: 9.0, .. }), "the far end is tried: {last:?}");
}

/// What works beyond the first failure is neither found nor looked for.
#[test]
fn islands_are_not_looked_for() {
    let ladder = Ladder::Arithmetic { from: 0.0, step: 1.0, to: 20.0 };
    let island = |x: f64| x < 3.3 || (5.0..15.0).contains(&x);
    let (limit, tried) = found(ladder, Tolerance::Absolute(1e-6), island);
    assert!((limit.value() - 3.3).abs() < 1e-6, "{limit:?}");
    assert!(tried.iter().all(|x| *x <= 4.0), "{tried:?}");
}

#[test]
fn an_error_ends_a_search() {
    let ladder = Ladder::Arithmetic { from: 0.0, step: 1.0, to: 20.0 };
    let attempt = |x: f64| if x < 3.0 { Ok(None::<()>) } else { Err(x) };
    assert_eq!(search(ladder, Tolerance::Absolute(0.1), attempt), Err(3.0));
}

fn experiment_1() -> Scene {
    load("experiment-1").expect("built in")
}

fn trial(scene: &Scene, quantity: Quantity, outline: Outline) -> Trial<'_> {
    let (footing, control) = (Footing::Sole(outline), Loop::Bare);
    Trial { scene, quantity, footing, control, criterion: Criterion::default() }
}

/// Limits of real runs, found with a coarse tolerance: three hundredths on either side the run works, and
/// fails in the manner that was told.
#[test]
fn limits_of_real_runs_hold() {
    let rises = experiment_1();
    let is_struck = load("experiment-2").expect("built in");
    for (scene, quantity, outline, step, harder, expected) in [
        (&rises, Quantity::Friction, Outline::A, 2e-3, 0.97, Manner::Slip),
        (&rises, Quantity::Friction, Outline::M, 1e-3, 0.97, Manner::Slip),
        (&rises, Quantity::GainScale, Outline::A, 5e-4, 1.03, Manner::Tip),
        (&is_struck, Quantity::BlockSpeed, Outline::A, 2e-3, 1.03, Manner::Tip),
        (&is_struck, Quantity::Delay, Outline::A, 1e-3, 1.03, Manner::Tip),
        (&is_struck, Quantity::Noise, Outline::A, 2e-3, 1.03, Manner::DoesNotSettle),
        (&is_struck, Quantity::TorqueShare, Outline::A, 2e-3, 0.97, Manner::TorqueLimit),
    ] {
        let trial = trial(scene, quantity, outline);
        let ladder = quantity.ladder(scene).expect("a robot on a floor");
        let limit = search(ladder, Tolerance::Relative(0.02), |x| trial.attempt(x, step))
            .expect("values that the scene may have");
        println!("{quantity:?}, {outline:?}: {limit:?}");
        let Found::Limit { works, manner, .. } = limit else { panic!("{limit:?}") };
        assert_eq!(manner, expected, "{quantity:?}");
        assert_eq!(trial.attempt(works / harder, step), Ok(None), "{quantity:?}");
        assert_eq!(trial.attempt(works * harder, step), Ok(Some(expected)), "{quantity:?}");
    }
}

/// Every quantity reaches the scene that is run, in steps of which a control period has a whole number.
#[test]
fn quantities_are_set_in_the_scene() {
    let scene = experiment_1();
    for quantity in Quantity::ALL {
        let trial = trial(&scene, quantity, Outline::M);
        if quantity.ladder(&scene).is_none() {
            assert_eq!(quantity, Quantity::BlockSpeed, "only a block is missing");
            continue;
        }
        let value = match quantity {
            Quantity::ControlRate => 333.0,
            Quantity::Delay => 0.07,
            _ => 1.07,
        };
        let changed = trial.scene_at(value, 2e-3);
        changed.check().unwrap_or_else(|error| panic!("{quantity:?}: {error}"));
        assert!(changed.integrator.step_s <= 2e-3);
        assert_eq!(changed.duration_s, 4.0);
        if let Some(set) = quantity.of(&changed).filter(|_| quantity != Quantity::GainScale) {
            assert_eq!(set, value, "{quantity:?}");
        }
        let same = trial.scene_at(quantity.of(&scene).unwrap_or(0.5), 2e-3);
        assert_ne!(same, changed, "{quantity:?} changes nothing");
    }
    let stronger = trial(&scene, Quantity::GainScale, Outline::A).scene_at(4.0, 2e-3).controller;
    assert_eq!(stronger.position_gain, [200.0, 200.0, 800.0]);
    assert_eq!(stronger.angular_velocity_gain, [14.14; 3]);
}

/// How a scene fails; its record as well.
fn failed(scene: &Scene) -> (Option<Manner>, Run) {
    scene.check().expect("a scene");
    let (run, fault) = play(scene, Loop::Bare);
    (Ending { scene, run: &run, fault }.manner(&Criterion::default()), run)
}

#[test]
fn manners_of_real_runs() {
    let mut slippery = experiment_1();
    Quantity::Friction.set(&mut slippery, 0.0);
    assert_eq!(failed(&slippery).0, Some(Manner::Slip));

    // Without overshoot the feet stay down until a knee is straight.
    let mut high = experiment_1();
    high.controller.velocity_gain[2] = 20.0;
    high.set_point.position_m[2] = 1.178;
    assert_eq!(failed(&high).0, Some(Manner::SingularLeg));

    let mut pushed = experiment_1();
    for force_n in [[0.0, 100.0, 0.0], [200.0, 0.0, 0.0], [-150.0, 0.0, 0.0]] {
        pushed.pushes = vec![Push { at_s: 2.0, duration_s: 0.5, force_n }];
        assert_eq!(failed(&pushed).0, Some(Manner::Tip), "{force_n:?}");
    }
    let mut slow = experiment_1();
    slow.duration_s = 4.0;
    Quantity::ControlRate.set(&mut slow, 10.0);
    assert_eq!(failed(&slow).0, Some(Manner::Runaway));

    let unreachable = trial(&slippery, Quantity::SetPointHeight, Outline::A);
    assert_eq!(unreachable.attempt(1.3, 2e-3), Ok(Some(Manner::NotReachable)));
}

/// What no scene of today shows, from records that are changed.
#[test]
fn manners_of_constructed_records() {
    let scene = experiment_1();
    let (works, run) = failed(&scene);
    assert_eq!(works, None);
    let judge = |scene: &Scene, run: &Run, criterion: &Criterion| {
        Ending { scene, run, fault: None }.manner(criterion)
    };
    let usual = Criterion::default();
    let strict = Criterion { distance_m: 1e-12, ..usual };
    assert_eq!(judge(&scene, &run, &strict), Some(Manner::DoesNotSettle));

    let mut broken = run.clone();
    broken.failure =
        Some(Failure { kind: "step", time_s: 3.0, place: String::new(), advice: String::new() });
    assert_eq!(judge(&scene, &broken, &usual), Some(Manner::StepFailure));

    // The same record, of motors that give no more than it shows at one joint in its last half second.
    let mut weak = scene.clone();
    let knee = 3;
    let mut limits = biped::LIMITS.joints[0].map(|joint| joint.torque);
    limits[knee] = 20.0;
    weak.acting.torque_limits_nm = Some(limits);
    let share_cut = |share: f64| {
        let mut cut = broken.clone();
        let end = cut.samples.len();
        for sample in &mut cut.samples {
            sample.torques[knee] = 19.0;
            sample.torques[6 + knee] = 19.0;
        }
        for sample in &mut cut.samples[end - (500.0 * share) as usize..] {
            sample.torques[6 + knee] = -20.0;
        }
        judge(&weak, &cut, &usual)
    };
    assert_eq!(share_cut(0.6), Some(Manner::TorqueLimit));
    assert_eq!(share_cut(0.4), Some(Manner::StepFailure));
    assert_eq!(judge(&scene, &run, &usual), None, "a run that works has no manner");

    let mut fallen = broken.clone();
    fallen.failure.as_mut().expect("one").kind = "fell";
    assert_eq!(judge(&scene, &fallen, &usual), Some(Manner::Collapse));

    let mut wild = broken.clone();
    wild.samples[1200].torques[5] = 601.0;
    assert_eq!(judge(&scene, &wild, &usual), Some(Manner::Runaway));
    for sample in &mut wild.samples[1100..] {
        sample.contacts = Some(
            [[ContactState::Sticking, ContactState::Free]; 2]
                .map(|[a, b]| vec![a, a, b, b])
                .to_vec(),
        );
    }
    assert_eq!(judge(&scene, &wild, &usual), Some(Manner::Tip));
}

fn temporary(name: &str) -> PathBuf {
    let file = format!("surefoot-limits-{name}-{}.json", std::process::id());
    std::env::temp_dir().join(file)
}

/// A survey that was broken off gives what an uninterrupted one gives, without doing again what was done;
/// other rules or another program start anew; a file that is none is an error.
#[test]
fn a_survey_is_taken_up_again() {
    let scene = experiment_1();
    let quantities = [Quantity::Friction, Quantity::GainScale];
    let criterion = Criterion::default();
    let loops = [Loop::Supervised];
    let survey = Survey { scene: &scene, quantities: &quantities, loops: &loops, criterion };
    let path = temporary("resume");
    let store = Store::new(&path, &scene, &criterion, b"this program");
    store.forget().expect("nothing there");
    let calls = Mutex::new(Vec::new());
    let run = |store: &Store| -> Vec<Cell> {
        calls.lock().expect("no panic").clear();
        let done = |done, all| calls.lock().expect("no panic").push((done, all));
        survey.find(store, &done).expect("a survey")
    };
    let whole = run(&store);
    assert_eq!(whole.len(), 4);
    assert!(whole.iter().all(|cell| cell.agrees() && cell.levels.len() >= 2), "{whole:?}");
    assert_eq!(*calls.lock().expect("no panic"), [(0, 4), (1, 4), (2, 4), (3, 4), (4, 4)]);
    assert_eq!(store.finished().expect("a file").len(), 4, "each was kept");

    store.keep(&[whole[2].clone()]).expect("writable");
    assert_eq!(survey.missing(&store.finished().expect("a file")).len(), 3);
    assert_eq!(run(&store), whole);
    assert_eq!(*calls.lock().expect("no panic"), [(1, 4), (2, 4), (3, 4), (4, 4)]);
    assert_eq!(run(&store), whole);
    assert_eq!(*calls.lock().expect("no panic"), [(4, 4)]);

    let other_program = Store::new(&path, &scene, &criterion, b"another program");
    let strict = Criterion { distance_m: 1e-3, ..criterion };
    let other_criterion = Store::new(&path, &scene, &strict, b"this program");
    let longer = Scene { duration_s: 5.0, ..scene.clone() };
    let other_scene = Store::new(&path, &longer, &criterion, b"this program");
    for other in [other_program, other_criterion, other_scene] {
        assert!(other.finished().expect("a file").is_empty());
    }
    std::fs::write(&path, "{ \"fingerprint\": \"half a fi").expect("writable");
    assert!(store.finished().is_err());
    store.forget().expect("writable");
    assert!(store.finished().expect("no file").is_empty());
}

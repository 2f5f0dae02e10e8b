//! How long steps may be: what is foretold against what is found.

use super::trees::{floating_chain, mixed_tree};
use surefoot_host::stability::{TreeMotion, scan_one};
use surefoot_mechanics::integrators::{Method, StepFailure};
use surefoot_multibody::{BodyState, Chain, ChainJoint, Simulation, StepForecast, System};

const SECONDS: f64 = 1.0;

type Start = (System, Vec<BodyState>, Vec<BodyState>);

/// Along an accurate motion.
fn foretold((system, states, rates): &Start) -> StepForecast {
    let mut simulation =
        Simulation::new(system.clone(), SECONDS / 4000.0, states, rates).expect("a start");
    let mut forecast = StepForecast::default();
    for step in 0..4000 {
        if step % 100 == 0 {
            forecast = forecast.and(simulation.forecast().expect("regular"));
        }
        simulation.step().expect("a step");
    }
    forecast
}

fn works((system, states, rates): &Start, h: f64) -> bool {
    let simulation = Simulation::new(system.clone(), h, states, rates).expect("a start");
    let mut simulation = simulation.without_splitting();
    (0..(SECONDS / h).ceil() as usize).all(|_| simulation.step().is_ok())
}

/// The longest step that works, by a scan of 3 % from well above what is foretold.
fn found(start: &Start, from: f64) -> f64 {
    let mut h = from;
    while !works(start, h) {
        h *= 0.97;
    }
    h
}

fn hanging(links: usize, joint: ChainJoint, bend: f64) -> Start {
    let chain = Chain { links, joint, ..super::motion::CHAIN };
    let still = vec![[0.0; 7]; links];
    (chain.system().expect("a system"), chain.bent(bend), still)
}

/// Hanging chains and trees afloat, slow and fast.
fn motions() -> Vec<(String, Start)> {
    let faster = |(system, states, rates): Start, by: f64| {
        (system, states, rates.into_iter().map(|r| r.map(|x| by * x)).collect())
    };
    let mut motions: Vec<(String, Start)> = Vec::new();
    for links in [3, 7, 12] {
        for bend in [0.1, 0.35, 0.8] {
            let start = hanging(links, ChainJoint::Revolute, bend);
            motions.push((format!("{links} hinges, {bend} rad"), start));
            let start = hanging(links, ChainJoint::Spherical, bend);
            motions.push((format!("{links} balls, {bend} rad"), start));
        }
    }
    for by in [0.5, 2.0] {
        for links in [4, 12] {
            let start = faster(floating_chain(links, ChainJoint::Alternating), by);
            motions.push((format!("{links} floating, {by} times"), start));
        }
        motions.push((format!("tree, {by} times"), faster(mixed_tree(25), by)));
    }
    motions
}

/// On motions that the forecast's two constants were not measured on.
#[test]
fn longest_steps_are_foretold() {
    let motions = motions();
    let (mut within, mut too_long, mut most) = (0, 0, 0.0_f64);
    for (name, start) in &motions {
        let forecast = foretold(start).step_s().expect("a limit");
        let longest = found(start, 4.0 * forecast);
        let ratio = forecast / longest;
        println!("{name}: foretold {forecast:.2e} s, found {longest:.2e} s, {ratio:.2}");
        within += usize::from((0.5..=2.0).contains(&ratio));
        too_long += usize::from(ratio > 1.1);
        most = most.max(ratio);
    }
    println!(
        "{within} of {} within a factor of two; {too_long} more than a tenth too long, {most:.2} times at \
         most",
        motions.len()
    );
    assert!(10 * within >= 9 * motions.len());
    // Those that whip about are not foretold to a tenth.
    assert!(6 * too_long <= motions.len() && most < 2.0, "{too_long}, {most}");
}

/// The forecast of `chart stability`, on the same motions; none was used to make it.
#[test]
fn longest_steps_are_foretold_by_probes() {
    let (mut near, mut bold, mut cells) = (0, 0, 0);
    for (name, (system, states, rates)) in motions() {
        let motion = TreeMotion { system, states, rates, duration_s: SECONDS };
        let problem = motion.problem("tree", "");
        let limit = scan_one(&problem, Method::Variational, 1.03).expect("made for it");
        let agreement = limit.agreement();
        println!("{name}: {agreement:?}, {:?} by {:?}", limit.works_to_s, limit.kind);
        cells += 1;
        near += usize::from(agreement.is_near());
        bold += usize::from(agreement.is_unsafe());
    }
    println!("{near} of {cells} within a factor of two; {bold} more than a tenth too long");
    assert!(10 * near >= 9 * cells);
    assert_eq!(bold, 0);
}

/// A step far too long is a failure with its reason, or is made in shorter ones and counted.
#[test]
fn steps_too_long_are_split_or_refused() {
    let (system, states, rates) = hanging(10, ChainJoint::Alternating, 0.3);
    let h = 0.2;
    let start = || Simulation::new(system.clone(), h, &states, &rates).expect("a start");
    let mut refused = start().without_splitting();
    let failure = loop {
        let before = refused.states();
        if let Err(failure) = refused.step() {
            assert_eq!(refused.states(), before, "a failed step changes nothing");
            break failure;
        }
        assert!(refused.progress().steps < 100, "0.2 s is too long for this chain");
    };
    println!("{failure}");
    // In shorter ones it goes on for a while; but not for ever.
    let mut split = start();
    let failure = loop {
        if let Err(failure) = split.step() {
            break failure;
        }
        assert!(split.system().largest_constraint(&split.states()) < 1e-10);
        assert!(split.progress().steps < 100, "0.2 s is too long for this chain");
    };
    println!("{failure}");
    assert_eq!(failure.failure, StepFailure::TooManySplits { splits: 11 });
    assert_eq!(split.progress().split_steps, 10);
}

/// Numbers that are none do no harm.
#[test]
fn bad_loads_are_failures() {
    for bad in [f64::NAN, f64::INFINITY, 1e300] {
        let (system, states, rates) = hanging(4, ChainJoint::Revolute, 0.3);
        let mut simulation = Simulation::new(system, 1e-3, &states, &rates).expect("a start");
        simulation.set_torque(2, bad);
        let failure = simulation.step().expect_err("not a torque");
        println!("{bad:e}: {failure}");
        assert_eq!(simulation.progress().steps, 0);
        // It goes on once the load is one.
        simulation.set_torque(2, 0.1);
        simulation.step().expect("a step");
        assert!(simulation.states().as_flattened().iter().all(|x| x.is_finite()));
    }
}

//! Plants by themselves.

use surefoot::model::robots::biped::{SoleOutline, TREE};
use surefoot_mechanics::integrators::Method;
use surefoot_multibody::contact::{ContactState, Floor};
use surefoot_sim::closed_loop;
use surefoot_sim::plant::{OnFloor, Plant, PlantState, Welded};
use surefoot_sim::scene::load;

/// No floor below: the robot falls, and its energy drifts by what the method is known to do to a fall:
/// velocities first makes it fall `g h t / 2` further than it should, and lose `m g² h t / 2`. Spins
/// add less than 1 % to that here.
#[test]
fn a_free_robot_falls() {
    let mut state = load("experiment-1").expect("built in").initial.state();
    state.positions[2] = 10.0;
    state.velocities = (0..18).map(|i| 0.3 * f64::from(i).sin()).collect();
    let energy = |plant: &mut OnFloor| {
        let seen = plant.observe().expect("a configuration");
        seen.kinetic_energy + seen.potential_energy
    };
    let drift = |h: f64| {
        let mut plant = OnFloor::new(&state, Floor::RUBBER, &SoleOutline::A);
        let before = energy(&mut plant);
        for _ in 0..(0.5 / h).round() as usize {
            plant.step(h, &[0.0; 12], None).expect("a regular motion");
        }
        assert_eq!(plant.contacts(), Some(vec![vec![ContactState::Free; 4]; 2]));
        before - energy(&mut plant)
    };
    let (coarse, fine) = (drift(2e-4), drift(1e-4));
    println!("{coarse} {fine}");
    let expected = 0.5 * TREE.mass() * 9.81 * 9.81 * 1e-4 * 0.5;
    assert!((fine / expected - 1.0).abs() < 0.01, "{fine} J, expected {expected} J");
    assert!((1.9..2.1).contains(&(coarse / fine)), "first order: {coarse} {fine}");
}

/// At rest the ground carries the weight: through contact forces, and, by another route, through the
/// reactions of welded feet.
#[test]
fn the_ground_carries_the_weight() {
    for name in ["experiment-1", "experiment-1-welded"] {
        let scene = load(name).expect("built in");
        let mut controller = closed_loop::controller(&scene, closed_loop::Scalar::F64);
        let run = closed_loop::run(&scene, controller.as_mut(), &mut |_| {});
        let last = run.samples.last().expect("samples");
        let carried = last.foot_forces.iter().sum::<f64>();
        assert!((carried / (TREE.mass() * 9.81) - 1.0).abs() < 1e-4, "{name}: {carried} N");
    }
}

/// The stated limit of the step is on the safe side.
#[test]
fn the_stated_step_limit_is_safe() {
    let mut scene = load("experiment-1").expect("built in");
    let limit = OnFloor::new(&scene.initial.state(), Floor::RUBBER, &SoleOutline::A)
        .step_limit()
        .expect("a floor limits the step");
    println!("stated limit {limit:e} s");
    scene.integrator.name = Method::SemiImplicitEuler;
    // The largest step below the limit that divides the tick.
    scene.integrator.step_s = 2e-3 / (2e-3 / limit).ceil();
    let mut controller =
        surefoot_sim::closed_loop::controller(&scene, surefoot_sim::closed_loop::Scalar::F64);
    let run = surefoot_sim::closed_loop::run(&scene, controller.as_mut(), &mut |_| {});
    assert_eq!(run.outcome, surefoot_sim::closed_loop::Outcome::Balanced, "{:?}", run.failure);
}

/// Bad states and torques end in a typed failure, and leave the state as it was.
#[test]
fn bad_numbers_are_failures() {
    let good = load("experiment-1").expect("built in").initial.state();
    for bad in [f64::NAN, f64::INFINITY, 1e300] {
        let mut plants: Vec<Box<dyn Plant>> = vec![
            Box::new(OnFloor::new(&good, Floor::RUBBER, &SoleOutline::A)),
            Box::new(Welded::new(&good).expect("a configuration")),
        ];
        for plant in &mut plants {
            let mut torques = [0.0; 12];
            torques[3] = bad;
            let failure = plant.step(1e-4, &torques, None).expect_err("not a torque");
            println!("{bad}: {failure}");
            assert_eq!(plant.state().expect("a state"), good);
        }
        let broken = PlantState { velocities: vec![bad; 18], ..good.clone() };
        let mut plant = OnFloor::new(&broken, Floor::RUBBER, &SoleOutline::A);
        assert!(plant.step(1e-4, &[0.0; 12], None).is_err());
        let mut broken = good.clone();
        broken.positions[8] = bad;
        if !bad.is_finite() {
            assert!(Welded::new(&broken).is_err());
        }
    }
}

//! Ends of the joints' ways, in all plants.

use surefoot::model::robots::biped::SoleOutline;
use surefoot_mechanics::integrators::Method;
use surefoot_multibody::Stops;
use surefoot_multibody::contact::Floor;
use surefoot_sim::closed_loop::{Run, Scalar, bare_controller, run};
use surefoot_sim::plant::{Additions, OnFloor, Plant, PlantState, Variational};
use surefoot_sim::robot::biped;
use surefoot_sim::scene::{Integrator, JointStops, Outline, load};

/// The left knee's angle and torque; its rate is one further back.
const KNEE: usize = 10;
const STIFFNESS: f64 = 2e3;

/// In free fall high above the floor, the left knee 3° from its stop.
fn start(knee_rate: f64) -> (PlantState, [Stops; 12]) {
    let mut state = load("experiment-1").expect("built in").initial.state();
    state.positions[2] = 10.0;
    state.velocities[KNEE - 1] = knee_rate;
    let mut stops = [Stops { low: -3.0, high: 3.0, stiffness: STIFFNESS }; 12];
    stops[3].low = state.positions[KNEE] - 3.0_f64.to_radians();
    (state, stops)
}

fn energy(plant: &mut dyn Plant) -> f64 {
    let seen = plant.observe().expect("a configuration");
    seen.kinetic_energy + seen.potential_energy
}

fn variational(state: &PlantState, stops: Option<&[Stops; 12]>, h: f64) -> Variational {
    let additions = Additions { stops: stops.map(|stops| stops.to_vec()), ..Additions::default() };
    let robot = biped(Outline::A);
    Variational::on_floor(&robot, state, h, Floor::RUBBER, &additions).expect("a plant")
}

fn baseline(state: &PlantState, stops: [Stops; 12]) -> OnFloor {
    OnFloor::new(state, Floor::RUBBER, &SoleOutline::A).with_stops(Some(stops.to_vec()))
}

/// States of 0.1 s in steps of `h`, every millisecond, under a torque on the knee.
fn motion(plant: &mut dyn Plant, h: f64, torque: f64) -> Vec<PlantState> {
    let mut torques = [0.0; 12];
    torques[3] = torque;
    let steps = (1e-3 / h).round() as usize;
    let millisecond = |_| {
        for _ in 0..steps {
            plant.step(h, &torques, None).expect("a step");
        }
        plant.state().expect("a state")
    };
    (0..100).map(millisecond).collect()
}

/// A knee that swings at 6 rad/s into its stop is turned around there, and all energy is given back.
#[test]
fn a_stop_gives_back_what_it_took() {
    let (state, stops) = start(-6.0);
    let h = 1e-3;
    let mut plant = variational(&state, Some(&stops), h);
    let before = energy(&mut plant);
    let states = motion(&mut plant, h, 0.0);
    let deepest = states.iter().map(|s| s.positions[KNEE]).fold(0.0, f64::min) - stops[3].low;
    let after = energy(&mut plant);
    let last = states.last().expect("states");
    println!("{:.3}° beyond the stop, energy {before:.6} → {after:.6} J", deepest.to_degrees());
    assert!((-20.0..-0.5).contains(&deepest.to_degrees()));
    assert!(last.positions[KNEE] > stops[3].low && last.velocities[KNEE - 1] > 0.5, "it came back");
    assert!((after - before).abs() < 1e-3 * (0.5 * STIFFNESS * deepest * deepest));
    // Without the stop the knee goes on.
    let free = motion(&mut variational(&state, None, h), h, 0.0);
    assert!(free.last().expect("states").positions[KNEE] < stops[3].low - 0.3);
}

/// Explicit springs at a small step play the same as laws of joints, and come nearer with the step: free,
/// and under a motor that holds the knee against its stop.
#[test]
fn plants_agree_on_stops() {
    for (rate, torque) in [(-6.0, 0.0), (0.0, -20.0)] {
        let (state, stops) = start(rate);
        let h = 2.5e-4;
        let ours = motion(&mut variational(&state, Some(&stops), h), h, torque);
        let apart = |h: f64| {
            let theirs = motion(&mut baseline(&state, stops), h, torque);
            let pairs = ours.iter().zip(&theirs);
            pairs
                .flat_map(|(a, b)| a.positions[7..].iter().zip(&b.positions[7..]))
                .map(|(a, b)| (a - b).abs())
                .fold(0.0, f64::max)
        };
        let (coarse, fine) = (apart(4e-5), apart(1e-5));
        let deepest = ours.iter().map(|s| s.positions[KNEE]).fold(0.0, f64::min) - stops[3].low;
        println!(
            "{rate} rad/s, {torque} N·m: {deepest:.4} rad beyond, {coarse:.1e} {fine:.1e} rad apart"
        );
        assert!(deepest < -5e-3, "the stop was reached");
        assert!(fine < 2e-3 && fine < 0.5 * coarse, "{coarse} {fine}");
    }
    // The energies that plants tell have the stops' in them.
    let (mut state, stops) = start(0.0);
    state.positions[KNEE] = stops[3].low - 0.1;
    let held = 0.5 * STIFFNESS * 0.01;
    let of_ours = energy(&mut variational(&state, Some(&stops), 1e-3));
    let of_theirs = energy(&mut baseline(&state, stops));
    let without = energy(&mut variational(&state, None, 1e-3));
    assert!((of_ours - without - held).abs() < 1e-9 && (of_theirs - without - held).abs() < 1e-6);
}

/// A knee that may not stretch as far as the set point asks: with welded feet both plants end up in the same
/// pose, beyond the stop by what the motors press.
#[test]
fn welded_plants_hold_knees_at_their_stops() {
    let wide = [[-170.0, 170.0]; 6];
    let mut left_deg = wide;
    left_deg[3] = [-170.0, -70.0];
    let stops = JointStops { left_deg, right_deg: wide, stiffness: 1e4 };
    let play = |name: Method, step_s: f64, joint_stops: Option<JointStops>| -> Run {
        let mut scene = load("experiment-1-welded").expect("built in");
        scene.integrator = Integrator { name, step_s };
        scene.acting.joint_stops = joint_stops;
        scene.duration_s = 0.5;
        scene.check().expect("a valid scene");
        // The plants' stops are looked at: a supervisor stops a body that is hurled up like this.
        let run = run(&scene, bare_controller(&scene, Scalar::F64).as_mut(), &mut |_| {});
        assert!(run.failure.is_none(), "{:?}", run.failure);
        run
    };
    let ours = play(Method::Variational, 1e-3, Some(stops));
    let theirs = play(Method::SemiImplicitEuler, 1e-4, Some(stops));
    let free = play(Method::Variational, 1e-3, None);
    let mut apart = 0.0_f64;
    let highest_of = |run: &Run| {
        let angles = run.samples.iter().map(|sample| sample.positions[KNEE].to_degrees());
        angles.fold(f64::NEG_INFINITY, f64::max)
    };
    for (a, b) in ours.samples.iter().zip(&theirs.samples) {
        for i in 0..19 {
            apart = apart.max((a.positions[i] - b.positions[i]).abs());
        }
    }
    let (highest, free) = (highest_of(&ours), highest_of(&free));
    println!("knee up to {highest:.3}°, without the stop {free:.3}°; {apart:.1e} apart");
    // Some 300 N·m press it 2° beyond.
    assert!((-69.0..-67.0).contains(&highest) && free > highest + 3.0, "{highest} {free}");
    assert!(apart < 1e-3, "{apart}");
}

//! §5.3's box: as printed, and thrown at random.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use surefoot_multibody::Simulation;
use surefoot_multibody::contact::{ContactState, Switching};
use surefoot_sim::scene::{AnyScene, JointEntry, Mechanism, Multibody, open};

/// The scene `box-drop`.
fn the_box() -> Multibody {
    let scene = match open("box-drop").expect("built in") {
        AnyScene::Mechanism(scene) => scene,
        AnyScene::Robot(_) => unreachable!("a mechanism"),
    };
    let Mechanism::Multibody(bodies) = scene.mechanism else { unreachable!("of bodies") };
    bodies
}

fn energy(simulation: &mut Simulation) -> f64 {
    let (kinetic, potential) = simulation.energies().expect("regular");
    kinetic + potential
}

fn is_down(simulation: &Simulation) -> [bool; 8] {
    std::array::from_fn(|k| simulation.contacts()[k].state != ContactState::Free)
}

/// Everything that §5.3 says of the run, in either reading of when a point is in the floor.
#[test]
fn the_box_does_what_is_printed() {
    for switching in [Switching::AtMidpoint, Switching::WithinTheStep] {
        let mut simulation = Multibody { switching, ..the_box() }.start(1e-3).expect("a start");
        let mut touched = [false; 8];
        let (mut first, mut settled) = (None, 0.0);
        let (mut last_y, mut back) = (0.0_f64, 0.0_f64);
        for _ in 0..1500 {
            simulation.step().expect("a step");
            let time = simulation.progress().time_s;
            let down = is_down(&simulation);
            for (touched, down) in touched.iter_mut().zip(down) {
                *touched |= down;
            }
            let y = simulation.state(0)[1];
            match first {
                None if down == [false; 8] => assert!(y.abs() < 1e-12, "{y}"),
                None => {
                    assert_eq!(down, [true, false, false, false, false, false, false, false]);
                    first = Some(time);
                }
                Some(_) => {
                    back = back.max(last_y - y);
                    last_y = last_y.max(y);
                }
            }
            let speed = simulation.rates().expect("rates")[0];
            if speed.iter().any(|v| v.abs() > 1e-2) {
                settled = time;
            }
        }
        let first = first.expect("an impact");
        println!(
            "{switching:?}: vertex 1 strikes at {first} s, at rest from {settled} s, y {last_y:.4} m with \
             {back:.1e} m back at most, {} iterations at most",
            simulation.progress().most_iterations
        );
        assert!((first - 0.102).abs() < 1e-9, "{first}");
        assert!((1.2..1.4).contains(&settled), "{settled}");
        // y grows; between two impacts, from 0.36 to 0.56 s, it drifts back by little of it.
        assert!(last_y > 0.02 && back < 0.1 * last_y, "{last_y} {back}");
        assert_eq!(touched, [true, true, false, false, true, true, true, true]);
        for (k, point) in simulation.contacts().iter().enumerate() {
            let expected = if k < 4 { ContactState::Free } else { ContactState::Sticking };
            assert_eq!(point.state, expected, "point {}", k + 1);
        }
        assert!(simulation.progress().most_iterations <= 5);
        // The floor carries the box, which sinks in by m g / (4 k).
        let sunk = 0.1 - simulation.state(0)[2];
        assert!((sunk - 70.0 * 9.81 / (4.0 * 75_000.0)).abs() < 1e-6, "{sunk}");
    }
}

/// 2000 random throws, friction from 0.1 to 1.2: all come to rest or fail for a stated reason, and none
/// gains energy.
#[test]
fn random_throws_come_to_rest() {
    let mut random = Pcg64Mcg::seed_from_u64(53);
    let mut uniform = |low: f64, high: f64| random.random_range(low..high);
    let (mut failures, mut gain, mut latest, mut splits, mut steps) = (0, 0.0_f64, 0.0_f64, 0, 0);
    for throw in 0..2000 {
        let mut scene = the_box();
        let friction = uniform(0.1, 1.2);
        let floor = scene.floor.as_mut().expect("a floor");
        (floor.static_friction, floor.dynamic_friction) = (friction, friction);
        let entry = &mut scene.bodies[0];
        let q: [f64; 4] = std::array::from_fn(|_| uniform(-1.0, 1.0));
        let norm = q.iter().map(|x| x * x).sum::<f64>().sqrt();
        entry.orientation = q.map(|x| x / norm);
        entry.center_m = [0.0, 0.0, uniform(0.3, 1.0)];
        entry.joint = JointEntry::Floating {
            velocity_m_s: [uniform(-5.0, 5.0), uniform(-5.0, 5.0), uniform(-3.0, 1.0)],
            angular_velocity_rad_s: std::array::from_fn(|_| uniform(-6.0, 6.0)),
        };
        let mut simulation = scene.start(1e-3).expect("a start");
        let start = energy(&mut simulation);
        loop {
            if let Err(error) = simulation.step() {
                println!("throw {throw}, friction {friction}: {error}");
                failures += 1;
                break;
            }
            if !simulation.progress().steps.is_multiple_of(10) {
                continue;
            }
            gain = gain.max(energy(&mut simulation) / start - 1.0);
            let (kinetic, _) = simulation.energies().expect("regular");
            let down = is_down(&simulation).iter().filter(|down| **down).count();
            if kinetic < 1e-9 && down >= 3 {
                break;
            }
            assert!(simulation.progress().time_s < 20.0, "throw {throw} does not come to rest");
        }
        latest = latest.max(simulation.progress().time_s);
        splits += simulation.progress().split_steps;
        steps += simulation.progress().steps;
    }
    println!(
        "{failures} failures, energy at most {gain:.1e} over its start, at rest after {latest:.1} s at \
         most; {splits} of {steps} steps made in shorter ones"
    );
    assert!(failures < 2, "{failures}");
    assert!(gain < 0.01, "{gain}");
}

/// What finding the switching times buys. A ball with one contact point, dropped: its rebound against the
/// closed form of the damped spring, step by step shorter.
#[test]
fn switching_within_the_step_keeps_the_order_at_touch_down() {
    let error = |switching, h: f64, drop: f64| {
        let mut scene = Multibody { switching, ..the_box() };
        scene.bodies[0].contact_points_m = vec![[0.0; 3]];
        scene.bodies[0].center_m = [0.0, 0.0, drop];
        scene.bodies[0].joint =
            JointEntry::Floating { velocity_m_s: [0.0; 3], angular_velocity_rad_s: [0.0; 3] };
        let floor = scene.floor.as_mut().expect("a floor");
        floor.normal_damping = 500.0;
        let (m, k, b, g) = (70.0, floor.normal_stiffness, floor.normal_damping, 9.81);
        let mut simulation = scene.start(h).expect("a start");
        // After 0.16 s it is in the floor.
        for _ in 0..(0.16 / h).round() as usize {
            simulation.step().expect("a step");
        }
        let meets = (2.0 * drop / g).sqrt();
        let (t, decay) = (0.16 - meets, b / (2.0 * m));
        let omega = (k / m - decay * decay).sqrt();
        let rest = -m * g / k;
        // z = rest + e^{-decay t} (A cos + B sin), z(0) = 0, z'(0) = −g·meets
        let a = -rest;
        let c = (-g * meets + decay * a) / omega;
        let exact = rest + (-decay * t).exp() * (a * (omega * t).cos() + c * (omega * t).sin());
        assert!(exact < 0.0, "still in the floor");
        (simulation.state(0)[2] - exact).abs()
    };
    // From many heights, so that touch-down is anywhere within a step; the worst of them.
    let worst = |switching, h: f64| -> f64 {
        (0..20).map(|i| error(switching, h, 0.1 + 3e-4 * f64::from(i))).fold(0.0, f64::max)
    };
    let order = |switching| {
        let (coarse, fine) = (worst(switching, 2e-3), worst(switching, 2.5e-4));
        println!("{switching:?}: {coarse:.1e} m at 2 ms, {fine:.1e} m at 0.25 ms");
        (coarse / fine).log2() / 3.0
    };
    let (midpoint, within) = (order(Switching::AtMidpoint), order(Switching::WithinTheStep));
    println!("order {midpoint:.2} at the midpoint, {within:.2} within the step");
    assert!((0.7..1.4).contains(&midpoint), "{midpoint}");
    assert!(within > 1.8, "{within}");
}

//! Hinges lumped: the biped of seven bodies.

use super::oracle::apart;
use nalgebra::Vector3;
use surefoot::model::robots::biped::{FEET, SoleOutline, TREE};
use surefoot::spatial::Quaternion;
use surefoot_multibody::contact::{Floor, Switching};
use surefoot_multibody::{
    Body, BodyState, Closing, Closure, Joint, JointConstraint, JointLaw, Reduced, Simulation, Site,
    System, SystemError, lumped, states_of_tree, system_of_tree,
};
use surefoot_sim::robot::SMALL_BODIES;

/// Joints of both models with motors, in the order of the hinges.
const LUMPED_JOINTS: [(usize, usize); 6] = [(1, 3), (2, 1), (3, 2), (4, 3), (5, 1), (6, 2)];

/// The biped with small bodies of `scale` times their mass and inertia; on a floor or far from any.
fn biped(scale: f64, gravity: f64, on_floor: bool) -> System {
    let mut links = system_of_tree(&TREE).expect("a system").links().to_vec();
    for (small, _) in SMALL_BODIES {
        let Body { mass, inertia } = links[small].body;
        links[small].body = Body { mass: scale * mass, inertia: inertia.map(|i| scale * i) };
    }
    let system = System::new(links, gravity).expect("a system");
    if !on_floor {
        return system;
    }
    let corners = SoleOutline::A.corners();
    let sites = FEET.into_iter().flat_map(|link| {
        corners.map(|corner: Vector3<f64>| Site { link, position: corner.into() })
    });
    system.on_floor(Floor::RUBBER, Switching::WithinTheStep, sites.collect()).expect("sites")
}

/// All joints bent and moving; on the floor, a crouch that falls onto flat feet.
fn start(on_floor: bool) -> (Vec<BodyState>, Vec<BodyState>) {
    let (mut q, mut v) = ([0.0; 19], [0.0; 18]);
    q[3] = 1.0;
    if on_floor {
        q[2] = 1.03;
        for leg in [7, 13] {
            q[leg + 1] = 40.0_f64.to_radians();
            q[leg + 3] = -77.4595_f64.to_radians();
            q[leg + 5] = (77.4595_f64 - 40.0).to_radians();
        }
    } else {
        q = std::array::from_fn(|i| 0.4 * (1.3 * i as f64 + 0.2).sin());
        let turn = Quaternion::from_axis_angle(Vector3::new(0.6, 0.0, 0.8), 0.5);
        q[3..7].copy_from_slice(&turn.to_array());
        v = std::array::from_fn(|i| 0.5 * (1.1 * i as f64 + 0.4).sin());
    }
    states_of_tree(&TREE, &q, &v).expect("a configuration")
}

fn torque(motor: usize, step: usize) -> f64 {
    0.5 * (0.7 * motor as f64 + 0.05 * step as f64).sin()
}

/// Both models' motion from the same start under the same torques; what is apart at the end: bodies that both
/// have, motors' angles, motors' rates.
fn deviation(scale: f64, on_floor: bool) -> [f64; 3] {
    let full = biped(scale, 9.81, on_floor);
    let reduced = lumped(&full, &SMALL_BODIES).expect("hinges that meet");
    let (states, rates) = start(on_floor);
    let h = 2e-3;
    let mut large = Simulation::new(full, h, &states, &rates).expect("a start");
    let (states, rates) = reduced.start(&states, &rates);
    let mut small = Simulation::new(reduced.system.clone(), h, &states, &rates).expect("a start");
    for step in 0..100 {
        for motor in 0..12 {
            large.set_torque(motor + 1, torque(motor, step));
        }
        let mut next = 0;
        for (joint, motors) in LUMPED_JOINTS {
            let all: Vec<f64> = (next..next + motors).map(|motor| torque(motor, step)).collect();
            small.set_torques(joint, &all);
            next += motors;
        }
        large.step().expect("a step");
        small.step().expect("a step");
    }
    let of_bodies = apart_where_told(&large, &mut small, &reduced);
    let mut of_angles = 0.0_f64;
    let mut next = 1;
    for (joint, motors) in LUMPED_JOINTS {
        for angle in &small.angles(joint)[..motors] {
            of_angles = of_angles.max((angle - large.angle(next)).abs());
            next += 1;
        }
    }
    let rates = large.observed_rates().expect("rates").to_vec();
    let of_rates = rates[6..].iter().zip(&small.observed_rates().expect("rates")[6..]);
    [of_bodies, of_angles, of_rates.fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()))]
}

pub fn apart_where_told(large: &Simulation, small: &mut Simulation, reduced: &Reduced) -> f64 {
    let rates = small.rates().expect("rates");
    let told = reduced.expanded(&small.states(), &rates);
    let both = told.iter().zip(large.states()).filter_map(|(a, b)| a.map(|(a, _)| (a, b)));
    let (a, b): (Vec<_>, Vec<_>) = both.unzip();
    apart(&a, &b)
}

/// The lumped biped is what the full one tends to as its small bodies vanish, in proportion to them, at a fixed
/// step: in flight and while it lands, under all motors.
#[test]
fn the_lumped_biped_is_the_limit_of_the_full_one() {
    for on_floor in [false, true] {
        let scales = [1.0, 0.1, 0.01, 1e-3, 1e-4];
        let all = scales.map(|scale| deviation(scale, on_floor));
        for (scale, [bodies, angles, rates]) in scales.iter().zip(&all) {
            println!(
                "floor {on_floor}, {scale}: {bodies:.2e}, {angles:.2e} rad, {rates:.2e} rad/s"
            );
        }
        for (quantity, name) in ["bodies", "angles", "rates"].iter().enumerate() {
            for pair in all.windows(2).skip(1) {
                let ratio = pair[0][quantity] / pair[1][quantity];
                assert!((8.0..12.5).contains(&ratio), "floor {on_floor}, {name}: {ratio}");
            }
        }
    }
}

/// Torques held by motors of spherical and universal joints are inner forces, which keep all momenta; and they
/// do the work of their angles: energy less that work stays in a band that falls with the square of the step.
#[test]
fn motors_keep_momenta_and_do_the_work_of_their_angles() {
    let torques: [f64; 12] = std::array::from_fn(|motor| 2.4 * torque(motor, 0));
    let bands = [2e-3, 1e-3].map(|h| {
        let reduced = lumped(&biped(1.0, 0.0, false), &SMALL_BODIES).expect("hinges");
        let (states, rates) = start(false);
        let (states, rates) = reduced.start(&states, &rates);
        let mut motion = Simulation::new(reduced.system, h, &states, &rates).expect("a start");
        let mut next = 0;
        for (joint, motors) in LUMPED_JOINTS {
            motion.set_torques(joint, &torques[next..next + motors]);
            next += motors;
        }
        let work = |motion: &Simulation| -> f64 {
            let angles = LUMPED_JOINTS
                .iter()
                .flat_map(|(joint, motors)| motion.angles(*joint).into_iter().take(*motors));
            angles.zip(torques).map(|(angle, torque)| angle * torque).sum()
        };
        let momentum = |motion: &mut Simulation| {
            let rates = motion.rates().expect("rates");
            let (linear, angular) = motion.system().momentum(&motion.states(), &rates);
            [linear, angular].concat()
        };
        let first = momentum(&mut motion);
        let begin = motion.energies().expect("energies").0 - work(&motion);
        let (mut band, mut moved) = (0.0_f64, 0.0_f64);
        for _ in 0..(0.4 / h) as usize {
            motion.step().expect("a step");
            let now = motion.energies().expect("energies").0 - work(&motion);
            band = band.max((now - begin).abs());
        }
        let size = first.iter().fold(0.0_f64, |m, p| m.max(p.abs()));
        for (a, b) in first.iter().zip(momentum(&mut motion)) {
            moved = moved.max((a - b).abs() / size);
        }
        let done = work(&motion);
        println!("h {h}: momenta move by {moved:.1e}, energy by {band:.1e} of {begin:.2} J, {done:.2} J of work");
        assert!(moved < 1e-12, "{moved}");
        band
    });
    let ratio = bands[0] / bands[1];
    assert!((3.5..4.5).contains(&ratio), "{ratio}");
}

/// A hip that is driven through a quarter turn stops with its name; the motion is where it was.
#[test]
fn a_gimbal_lock_is_an_error() {
    let reduced = lumped(&biped(1.0, 0.0, false), &SMALL_BODIES).expect("hinges");
    let mut q = [0.0; 19];
    q[3] = 1.0;
    q[8] = 1.2;
    let mut v = [0.0; 18];
    v[7] = 3.0;
    let (states, rates) = states_of_tree(&TREE, &q, &v).expect("a configuration");
    let (states, rates) = reduced.start(&states, &rates);
    let mut motion =
        Simulation::new(reduced.system.clone(), 2e-3, &states, &rates).expect("a start");
    let error = (0..500).find_map(|_| motion.step().err()).expect("a lock");
    assert!(error.to_string().contains("gimbal of joint 1"), "{error}");
    assert!(motion.angles(1)[1] > 1.4, "{:?}", motion.angles(1));
    q[8] = 1.55;
    let (states, rates) = states_of_tree(&TREE, &q, &v).expect("a configuration");
    let (states, rates) = reduced.start(&states, &rates);
    let refused = Simulation::new(reduced.system, 2e-3, &states, &rates);
    assert_eq!(refused.map(|_| ()), Err(SystemError::GimbalLock { link: 1 }));
}

#[test]
fn what_cannot_be_lumped_is_refused_with_its_reason() {
    let refused = |system: &System, small: &[(usize, _)], words: &str| {
        let error = lumped(system, small).map(|_| ()).expect_err(words).to_string();
        assert!(error.contains(words), "{error}");
    };
    let full = biped(1.0, 9.81, false);
    let law = JointLaw { damping: 1.0, ..JointLaw::default() };
    let held = full.clone().with_law(3, law).expect("a hinge");
    refused(&held, &SMALL_BODIES, "without springs");
    // The shank is no small body: its hinges' axes do not meet.
    refused(&full, &[(3, SMALL_BODIES[0].1)], "meets");
    refused(&full, &[(6, SMALL_BODIES[0].1)], "between two others");
    refused(&full, &[(99, SMALL_BODIES[0].1)], "between two others");
    refused(&full, &[(0, SMALL_BODIES[0].1)], "hang from");
    let weld = Joint {
        outboard: [0.0; 3],
        inboard: [0.0; 3],
        home: [1.0, 0.0, 0.0, 0.0],
        constraint: JointConstraint::Spherical,
    };
    let closure = Closure { outboard: 2, inboard: None, closing: Closing::Joint(weld) };
    refused(&full.with_closure(closure).expect("links"), &SMALL_BODIES, "fixed to it");
}

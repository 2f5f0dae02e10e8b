//! Motions in a plane, and of one free body: the same trajectory as in space.

use super::oracle::apart;
use nalgebra::Vector3;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use surefoot::spatial::Quaternion;
use surefoot_multibody::contact::{Floor, Switching};
use surefoot_multibody::{
    Body, BodyState, Closing, Closure, Frame, Joint, JointConstraint, JointLaw, Link, NotPlanar,
    NotSingle, PlanarError, PlanarSimulation, Simulation, SingleBody, SingleBodyError, Site, Stops,
    System, SystemError,
};

/// A system with a start.
struct Start {
    system: System,
    states: Vec<BodyState>,
    rates: Vec<BodyState>,
    torques: Vec<f64>,
}

fn turned(axis: Vector3<f64>, angle: f64) -> Quaternion<f64> {
    Quaternion::from_axis_angle(axis, angle)
}

/// Body, velocity and angular velocity, as a state and its rate.
fn state(frame: &Frame, v: Vector3<f64>, omega: Vector3<f64>) -> (BodyState, BodyState) {
    let q = frame.orientation;
    let whole = |p: Vector3<f64>, [s, i, j, k]: [f64; 4]| [p.x, p.y, p.z, s, i, j, k];
    let rate = q.rate(q.conjugate().rotate(omega)).to_array();
    (whole(frame.position, q.to_array()), whole(v, rate))
}

/// A random tree whose motion stays in a plane: held by the world, with bodies askew and beside one another, or
/// floating, with all of them in the plane; on a floor or above none; with springs, dampers, stops and motors.
fn random_planar_tree(seed: u64, floats: bool, on_floor: bool) -> Start {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut number = move |low: f64, high: f64| random.random_range(low..high);
    // The plane: upright, or any if nothing floats above no floor.
    let yaw = turned(Vector3::z(), number(-3.0, 3.0));
    let tilt = if floats || on_floor { 0.0 } else { number(-1.0, 1.0) };
    let frame_of_plane = yaw.product(turned(Vector3::x(), tilt));
    let seen = |x: f64, y: f64, z: f64| frame_of_plane.rotate(Vector3::new(x, y, z));
    let normal = seen(0.0, 1.0, 0.0);
    let (mut links, mut sites) = (Vec::<Link>::new(), Vec::new());
    let mut frames = Vec::<(Frame, Vector3<f64>, Vector3<f64>)>::new();
    let (mut laws, mut torques) = (Vec::new(), Vec::new());
    for k in 0..9_usize {
        let inboard = k.checked_sub(1 + (number(0.0, 2.0) as usize).min(k.saturating_sub(1)));
        let in_plane = turned(normal, number(-3.0, 3.0)).product(frame_of_plane);
        let askew = turned(Vector3::new(0.3, 0.5, 0.8).normalize(), number(-1.0, 1.0));
        let orientation = if floats { in_plane } else { in_plane.product(askew) };
        let beside = if floats { 0.0 } else { number(-0.2, 0.2) };
        let mut position = seen(number(-0.3, 0.3), beside, number(-0.3, 0.3));
        position += match inboard {
            Some(i) => frames[i].0.position - normal * normal.dot(&frames[i].0.position),
            None => Vector3::z() * if on_floor { 0.35 } else { 0.0 },
        };
        let frame = Frame { position, orientation };
        let (on, v_i, omega_i) = match inboard {
            Some(i) => frames[i],
            None => {
                let still =
                    Frame { position: Vector3::zeros(), orientation: Quaternion::identity() };
                (still, Vector3::zeros(), Vector3::zeros())
            }
        };
        let point = position + seen(number(-0.2, 0.2), number(-0.1, 0.1), number(-0.2, 0.2));
        let rate = number(-3.0, 3.0);
        let sign = if number(-1.0, 1.0) > 0.0 { 1.0 } else { -1.0 };
        let (constraint, omega, v) = match k {
            0 if floats => {
                let v = seen(number(-1.0, 1.0), 0.0, number(-1.0, 1.0));
                (JointConstraint::Floating, normal * rate, v)
            }
            3 | 6 => {
                let along = seen(number(-1.0, 1.0), 0.0, number(0.1, 1.0)).normalize();
                let axis = on.orientation.conjugate().rotate(along).into();
                let v = v_i + omega_i.cross(&(position - on.position)) + along * rate * 0.1;
                (JointConstraint::Prismatic { axis }, omega_i, v)
            }
            5 => {
                let v = v_i + omega_i.cross(&(position - on.position));
                (JointConstraint::Fixed, omega_i, v)
            }
            _ => {
                let axis = orientation.conjugate().rotate(normal * sign).into();
                let omega = omega_i + normal * rate;
                let of_point = v_i + omega_i.cross(&(point - on.position));
                let v = of_point + omega.cross(&(position - point));
                (JointConstraint::Revolute { axis }, omega, v)
            }
        };
        let at =
            |frame: &Frame| frame.orientation.conjugate().rotate(point - frame.position).into();
        let joint = Joint {
            outboard: at(&frame),
            inboard: at(&on),
            home: on.orientation.conjugate().product(orientation).to_array(),
            constraint,
        };
        let mass = number(0.5, 2.0);
        // Of a tree that floats the second axis is across the plane.
        let inertia = [0.02, 0.035, 0.03].map(|i| mass * i);
        links.push(Link { inboard, joint, body: Body { mass, inertia } });
        match k {
            2 | 3 => {
                let stops = (k == 2).then_some(Stops { low: -0.05, high: 0.04, stiffness: 60.0 });
                let rotor_inertia = 0.02 * mass;
                let law = JointLaw {
                    stiffness: 8.0,
                    rest: 0.2,
                    damping: 0.1,
                    friction: 0.2,
                    stops,
                    rotor_inertia,
                };
                laws.push((k, law));
            }
            _ => {}
        }
        torques.push(if k == 4 || k == 6 { number(-2.0, 2.0) } else { 0.0 });
        let arm = |side: f64| -> [f64; 3] {
            orientation.conjugate().rotate(seen(0.1, side, -0.12)).into()
        };
        sites.extend([0.07, -0.07].map(|side| Site { link: k, position: arm(side) }));
        frames.push((frame, v, omega));
    }
    let mut system = System::new(links, 9.81).expect("a system");
    for (link, law) in laws {
        system = system.with_law(link, law).expect("a law");
    }
    if on_floor {
        let floor = Floor { normal_damping: 300.0, ..Floor::RUBBER };
        system = system.on_floor(floor, Switching::WithinTheStep, sites).expect("a floor");
    }
    let (states, rates) = frames.iter().map(|(frame, v, omega)| state(frame, *v, *omega)).unzip();
    Start { system, states, rates, torques }
}

/// In a plane as in space: every body, the energy, and every contact point's state.
#[test]
fn a_planar_motion_is_the_one_in_space() {
    let mut touched = 0;
    for seed in 0..24 {
        let (floats, on_floor) = (seed % 2 == 0, seed % 4 > 1);
        let Start { system, states, rates, torques } = random_planar_tree(seed, floats, on_floor);
        let h = 1e-3;
        let mut space = Simulation::new(system.clone(), h, &states, &rates).expect("a start");
        let mut planar = match PlanarSimulation::new(system, h, &states, &rates) {
            Ok(planar) => planar,
            // Some of the trees that float tip over.
            Err(PlanarError::NotPlanar(NotPlanar::Tips { .. })) if floats => continue,
            Err(error) => panic!("{seed}: {error}"),
        };
        for (link, torque) in torques.iter().enumerate() {
            space.set_torque(link, *torque);
            planar.set_torque(link, *torque);
        }
        let energy = |(kinetic, potential): (f64, f64)| kinetic + potential;
        let mut worst = 0.0_f64;
        for step in 0..300 {
            space.step().unwrap_or_else(|error| panic!("{seed} {step}: {error}"));
            planar.step().unwrap_or_else(|error| panic!("{seed} {step}: {error}"));
            worst = worst.max(apart(&space.states(), &planar.states()));
            for (a, b) in space.contacts().iter().zip(planar.contacts()) {
                assert_eq!(a.state, b.state, "{seed}, step {step}");
                touched += usize::from(a.state != surefoot_multibody::contact::ContactState::Free);
            }
        }
        let (a, b) = (space.rates().expect("rates"), planar.rates().expect("rates"));
        let rate = a.iter().flatten().zip(b.iter().flatten());
        let rates = rate.fold(0.0_f64, |m, (a, b)| m.max((a.abs() - b.abs()).abs()));
        let energies = [space.energies(), planar.energies()].map(|e| energy(e.expect("energies")));
        println!(
            "{seed}: {worst:.1e}, rates {rates:.1e}, energy {:.1e}, {} and {} iterations",
            energies[0] - energies[1],
            space.progress().iterations,
            planar.progress().iterations
        );
        assert!(worst < 1e-9, "{seed}: {worst}");
        assert!(rates < 1e-6, "{seed}: {rates}");
        assert!((energies[0] - energies[1]).abs() < 1e-7, "{seed}: {energies:?}");
    }
    assert!(touched > 1000, "{touched}: too few contacts to tell");
}

/// What leaves the plane is told, and why.
#[test]
fn motions_that_leave_the_plane_are_told() {
    let why =
        |system: System, states: &[BodyState], rates: &[BodyState]| match PlanarSimulation::new(
            system, 1e-3, states, rates,
        ) {
            Err(PlanarError::NotPlanar(reason)) => reason,
            other => panic!("{other:?}"),
        };
    let still =
        Frame { position: Vector3::new(0.0, 0.0, 1.0), orientation: Quaternion::identity() };
    let body = |inertia: [f64; 3]| Body { mass: 1.0, inertia };
    let link = |inboard, constraint, inertia| {
        let home = [1.0, 0.0, 0.0, 0.0];
        let joint = Joint { outboard: [0.0; 3], inboard: [0.0; 3], home, constraint };
        Link { inboard, joint, body: body(inertia) }
    };
    let flat = [0.01, 0.03, 0.02];
    let free = |inertia: [f64; 3]| vec![link(None, JointConstraint::Floating, inertia)];
    let alone = |links: Vec<Link>| System::new(links, 9.81).expect("a system");
    let at = |v: Vector3<f64>, omega: Vector3<f64>| state(&still, v, omega);
    let (x, rest) = at(Vector3::zeros(), Vector3::zeros());
    let spin = at(Vector3::zeros(), Vector3::y()).1;

    assert!(PlanarSimulation::new(alone(free(flat)), 1e-3, &[x], &[spin]).is_ok());
    let sideways = at(Vector3::y(), Vector3::y()).1;
    assert_eq!(why(alone(free(flat)), &[x], &[sideways]), NotPlanar::Start { link: 0 });
    let oblique = at(Vector3::zeros(), Vector3::new(1.0, 1.0, 0.0)).1;
    assert_eq!(why(alone(free(flat)), &[x], &[oblique]), NotPlanar::Inertia { link: 0 });
    let upright = at(Vector3::zeros(), Vector3::z()).1;
    assert_eq!(why(alone(free(flat)), &[x], &[upright]), NotPlanar::Weight { link: 0 });
    let middle = alone(free([0.01, 0.02, 0.03]));
    assert_eq!(why(middle, &[x], &[spin]), NotPlanar::Tips { link: 0 });

    let revolute = |axis: [f64; 3]| JointConstraint::Revolute { axis };
    let chain = |second| {
        alone(vec![link(None, revolute([0.0, 1.0, 0.0]), flat), link(Some(0), second, flat)])
    };
    let origin = Frame { position: Vector3::zeros(), ..still };
    let (x0, _) = state(&origin, Vector3::zeros(), Vector3::zeros());
    let two = |second| why(chain(second), &[x0, x0], &[rest, rest]);
    assert_eq!(two(revolute([0.0, 0.0, 1.0])), NotPlanar::Axis { link: 1 });
    assert_eq!(two(revolute([0.0; 3])), NotPlanar::Axis { link: 1 });
    assert_eq!(
        two(JointConstraint::Prismatic { axis: [0.0, 1.0, 0.0] }),
        NotPlanar::Slide { link: 1 }
    );
    assert_eq!(two(JointConstraint::Spherical), NotPlanar::Joint { link: 1 });
    let closing = Closing::Joint(link(None, JointConstraint::Spherical, flat).joint);
    let looped = chain(revolute([0.0, 1.0, 0.0]))
        .with_closure(Closure { outboard: 1, inboard: None, closing })
        .expect("a loop");
    assert_eq!(why(looped, &[x0, x0], &[rest, rest]), NotPlanar::Loops);

    let floor = |positions: &[[f64; 3]]| {
        let sites = positions.iter().map(|position| Site { link: 0, position: *position });
        alone(free(flat))
            .on_floor(Floor::RUBBER, Switching::WithinTheStep, sites.collect())
            .expect("a floor")
    };
    let pair = [[0.1, 0.1, -0.1], [0.1, -0.1, -0.1]];
    assert!(PlanarSimulation::new(floor(&pair), 1e-3, &[x], &[spin]).is_ok());
    assert_eq!(why(floor(&pair[..1]), &[x], &[spin]), NotPlanar::Site { site: 0 });
}

/// Steps that turn a body too far fail as they do in space, with the motion where it was.
#[test]
fn steps_that_are_too_long_fail() {
    let Start { system, states, rates, .. } = random_planar_tree(1, false, false);
    let mut planar = PlanarSimulation::new(system.clone(), 0.6, &states, &rates).expect("a start");
    let before = planar.checkpoint().clone();
    let failure = (0..50).find_map(|_| planar.step().err()).expect("a failure");
    println!("{failure}");
    assert!(planar.states().iter().flatten().all(|x| x.is_finite()));
    // A start that is none, and a step that is none.
    let short = PlanarSimulation::new(system.clone(), 0.0, &states, &rates).err();
    assert_eq!(short, Some(PlanarError::System(SystemError::Step { h: 0.0 })));
    let mut other = PlanarSimulation::new(system, 0.1, &states, &rates).expect("a start");
    assert_eq!(other.restore(&before), Err(SystemError::OtherCheckpoint));
}

/// A free body in space: on a floor and above none, from random starts.
#[test]
fn a_single_body_moves_as_a_tree_of_one() {
    let mut random = Pcg64Mcg::seed_from_u64(7);
    let mut number = move |low: f64, high: f64| random.random_range(low..high);
    for case in 0..16 {
        let on_floor = case % 2 == 1;
        let mut vector = |size: f64| Vector3::from_fn(|_, _| number(-size, size));
        let frame = Frame {
            position: vector(0.2) + Vector3::z() * 0.4,
            orientation: Quaternion::from_rotation_vector(vector(2.0)),
        };
        let (x, v) = state(&frame, vector(2.0), vector(6.0));
        let joint = Joint {
            outboard: [0.0; 3],
            inboard: [0.0; 3],
            home: [1.0, 0.0, 0.0, 0.0],
            constraint: JointConstraint::Floating,
        };
        let body = Body { mass: 3.0, inertia: [0.02, 0.03, 0.04] };
        let mut system =
            System::new(vec![Link { inboard: None, joint, body }], 9.81).expect("a system");
        if on_floor {
            let corner = |k: usize, axis: usize| if k >> axis & 1 == 0 { 0.1 } else { -0.1 };
            let sites = (0..8).map(|k| Site { link: 0, position: [0, 1, 2].map(|a| corner(k, a)) });
            let floor = Floor { normal_damping: 200.0, ..Floor::RUBBER };
            system =
                system.on_floor(floor, Switching::WithinTheStep, sites.collect()).expect("a floor");
        }
        let mut tree = Simulation::new(system.clone(), 1e-3, &[x], &[v]).expect("a start");
        let mut single = SingleBody::new(system, 1e-3, &[x], &[v]).expect("a start");
        let (mut worst, mut down) = (0.0_f64, 0);
        for step in 0..600 {
            tree.step().unwrap_or_else(|error| panic!("{case} {step}: {error}"));
            single.step().unwrap_or_else(|error| panic!("{case} {step}: {error}"));
            worst = worst.max(apart(&tree.states(), &[single.state()]));
            for (a, b) in tree.contacts().iter().zip(single.contacts()) {
                assert_eq!(a.state, b.state, "{case}, step {step}");
                down += usize::from(a.state != surefoot_multibody::contact::ContactState::Free);
            }
        }
        let (a, b) = (tree.energies().expect("energies"), single.energies());
        let rates = (tree.rates().expect("rates")[0], single.rate());
        let rate = (0..7).map(|i| (rates.0[i] - rates.1[i]).abs()).fold(0.0_f64, f64::max);
        println!("{case}: {worst:.1e}, rates {rate:.1e}, {down} points down");
        assert!(worst < 1e-9, "{case}: {worst}");
        assert!(rate < 1e-7, "{case}: {rate}");
        assert!((a.0 + a.1 - b.0 - b.1).abs() < 1e-7, "{case}: {a:?} {b:?}");
        assert_eq!(on_floor, down > 0, "{case}");
    }
}

/// What is no single free body is told.
#[test]
fn what_is_no_single_body_is_told() {
    let Start { system, states, rates, .. } = random_planar_tree(0, true, false);
    let found = SingleBody::new(system, 1e-3, &states, &rates).err();
    assert_eq!(found, Some(SingleBodyError::NotSingle(NotSingle::Links { links: 9 })));
    let Start { system, states, rates, .. } = random_planar_tree(1, false, false);
    let first = System::new(system.links()[..1].to_vec(), 9.81).expect("a system");
    let found = SingleBody::new(first, 1e-3, &states[..1], &rates[..1]).err();
    assert_eq!(found, Some(SingleBodyError::NotSingle(NotSingle::Held)));
}

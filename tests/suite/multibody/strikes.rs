//! Free bodies that strike others.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use surefoot_multibody::contact::{Floor, Switching, YieldingBox};
use surefoot_multibody::{
    Body, BodyState, Joint, JointConstraint, Link, Simulation, Striker, System, SystemError,
};

const SURFACE: Floor = Floor {
    normal_stiffness: 10_000.0,
    normal_damping: 100.0,
    tangential_stiffness: 10_000.0,
    tangential_damping: 100.0,
    static_friction: 0.3,
    dynamic_friction: 0.3,
    zero_velocity_threshold: 1e-3,
};

const AROUND: YieldingBox =
    YieldingBox { center: [0.0; 3], half_size: [0.13, 0.15, 0.3], surface: SURFACE };

/// The body struck, 45 kg, and a cube of 1.8 kg.
const BODIES: [Body; 2] =
    [Body { mass: 45.0, inertia: [1.67, 1.58, 0.581] }, Body { mass: 1.8, inertia: [0.00192; 3] }];

const H: f64 = 1e-3;

fn free(body: Body) -> Link {
    let joint = Joint {
        outboard: [0.0; 3],
        inboard: [0.0; 3],
        home: [1.0, 0.0, 0.0, 0.0],
        constraint: JointConstraint::Floating,
    };
    Link { inboard: None, joint, body }
}

fn striker(surface: Floor) -> Striker {
    Striker {
        link: 1,
        points: Striker::box_points([0.08; 3]).to_vec(),
        struck: 0,
        around: YieldingBox { surface, ..AROUND },
        switching: Switching::WithinTheStep,
    }
}

/// Two free bodies without weight, from these states and rates.
fn two(surface: Floor, h: f64, states: [BodyState; 2], rates: [BodyState; 2]) -> Simulation {
    let links = BODIES.map(free).to_vec();
    let system = System::new(links, 0.0)
        .and_then(|system| system.with_striker(striker(surface)))
        .expect("a system");
    Simulation::new(system, h, &states, &rates).expect("a start")
}

fn momentum(simulation: &mut Simulation) -> [f64; 6] {
    let (states, rates) = (simulation.states(), simulation.rates().expect("regular"));
    let (linear, angular) = simulation.system().momentum(&states, &rates);
    let [[a, b, c], [d, e, f]] = [linear, angular];
    [a, b, c, d, e, f]
}

fn energy(simulation: &mut Simulation) -> f64 {
    let (kinetic, potential) = simulation.energies().expect("regular");
    kinetic + potential
}

/// A square hit in the middle: one mass on a spring and a damper, which may not pull.
#[test]
fn a_square_hit_is_a_mass_on_a_spring() {
    // One spring and damper for each of five points: four corners and the middle of a face.
    let (k, b) = (5.0 * SURFACE.normal_stiffness, 5.0 * SURFACE.normal_damping);
    let mass = 1.0 / (1.0 / BODIES[0].mass + 1.0 / BODIES[1].mass);
    let expected = {
        // x'' = −(k x + b x')/m from x = 0 at 4.5 m/s, by Runge and Kutta's method, until the force ends.
        let force = |x: f64, v: f64| -(k * x + b * v);
        let (mut x, mut v, h) = (0.0, 4.5, 1e-6);
        while force(x, v) < 0.0 {
            let f = |x: f64, v: f64| (v, force(x, v) / mass);
            let (a1, b1) = f(x, v);
            let (a2, b2) = f(x + 0.5 * h * a1, v + 0.5 * h * b1);
            let (a3, b3) = f(x + 0.5 * h * a2, v + 0.5 * h * b2);
            let (a4, b4) = f(x + h * a3, v + h * b3);
            x += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
            v += h / 6.0 * (b1 + 2.0 * b2 + 2.0 * b3 + b4);
        }
        -v / 4.5
    };
    let restitution = |h: f64| {
        let at = [[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0], [0.18, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]];
        let mut moving = [0.0; 7];
        moving[0] = -4.5;
        let mut simulation = two(SURFACE, h, at, [[0.0; 7], moving]);
        while simulation.progress().time_s < 0.1 - 0.5 * h {
            simulation.step().expect("a step");
        }
        let rates = simulation.rates().expect("regular");
        (rates[1][0] - rates[0][0]) / 4.5
    };
    let errors = [2e-3, 1e-3, 5e-4, 2.5e-4].map(|h| restitution(h) - expected);
    println!("restitution {expected:.5}, errors at 2, 1, ½, ¼ ms {errors:.2?}");
    assert!(errors[0].abs() < 0.01 && errors[3].abs() < 1e-3, "{errors:?}");
    assert!(errors[3].abs() < 0.2 * errors[0].abs(), "{errors:?}");
}

fn random_vector(random: &mut Pcg64Mcg, size: f64) -> [f64; 3] {
    std::array::from_fn(|_| random.random_range(-size..size))
}

/// Thrown at random, at any face, edge and corner: momentum and its moment are kept to round-off, energy
/// never grows, no step fails, and nothing ends inside the box.
#[test]
fn random_strikes_keep_momentum_and_make_no_energy() {
    let mut random = Pcg64Mcg::seed_from_u64(11);
    let (mut drift, mut gain, mut struck) = (0.0_f64, f64::NEG_INFINITY, 0);
    let (mut made, mut split) = (0, 0);
    for throw in 0..1000 {
        let towards = random_vector(&mut random, 1.0);
        let length = towards.iter().map(|x| x * x).sum::<f64>().sqrt().max(0.1);
        let speed = random.random_range(0.5..8.0);
        let aim = random_vector(&mut random, 0.2);
        let mut of = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
        let mut rates = [[0.0; 7]; 2];
        for i in 0..3 {
            of[i] = 0.6 * towards[i] / length;
            rates[1][i] = (aim[i] - of[i]) / 0.6 * speed;
        }
        // Spins: q̇ = ½ ω ⋆ q at the identity.
        for (rate, size) in rates.iter_mut().zip([1.0, 10.0]) {
            let spin = random_vector(&mut random, size);
            rate[4..].copy_from_slice(&spin.map(|x| 0.5 * x));
        }
        let surface = Floor {
            normal_damping: random.random_range(0.0..300.0),
            static_friction: random.random_range(0.0..1.0),
            ..SURFACE
        };
        let at = [[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0], of];
        let mut simulation = two(surface, 1e-3, at, rates);
        let (p0, e0) = (momentum(&mut simulation), energy(&mut simulation));
        let steps = (1.2 / speed / 1e-3) as usize;
        let mut touched = false;
        for step in 0..steps {
            simulation.step().unwrap_or_else(|error| panic!("throw {throw}, step {step}: {error}"));
            touched |= simulation.strike_forces()[0] != [0.0; 3];
        }
        struck += usize::from(touched);
        let p1 = momentum(&mut simulation);
        let size = 1.8 * speed;
        for (a, b) in p0.iter().zip(&p1) {
            drift = drift.max((a - b).abs() / size);
        }
        gain = gain.max((energy(&mut simulation) - e0) / e0);
        made += simulation.progress().steps;
        split += simulation.progress().split_steps;
    }
    println!(
        "{struck} of 1000 strike; momentum {drift:.1e}, energy {gain:.1e} at most; {split} of {made} steps split"
    );
    assert!(struck > 300);
    assert!(drift < 1e-11, "{drift}");
    assert!(gain < 1e-12, "{gain}");
    assert!(split * 10_000 < made, "{split} of {made}");
}

/// Strikers that cannot be are refused.
#[test]
fn bad_strikers_are_refused() {
    let system = || System::new(BODIES.map(free).to_vec(), 0.0).expect("a system");
    let bad: [Striker; 5] = [
        Striker { link: 2, ..striker(SURFACE) },
        Striker { link: 0, struck: 1, ..striker(SURFACE) },
        Striker { struck: 1, ..striker(SURFACE) },
        Striker { points: vec![[f64::NAN, 0.0, 0.0]], ..striker(SURFACE) },
        Striker {
            around: YieldingBox { half_size: [0.0, 0.1, 0.1], ..AROUND },
            ..striker(SURFACE)
        },
    ];
    for striker in bad {
        let error = system().with_striker(striker).expect_err("refused");
        assert_eq!(error, SystemError::Striker { striker: 0 });
    }
    // A link after those that strike.
    let late = system().with_striker(striker(SURFACE)).and_then(|s| s.with_link(free(BODIES[0])));
    let at = |x: f64| [x, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
    let error = Simulation::new(late.expect("links"), H, &[0.0, 1.0, 2.0].map(at), &[[0.0; 7]; 3]);
    assert_eq!(error.expect_err("refused"), SystemError::Striker { striker: 0 });
    let surface = Floor { normal_stiffness: -1.0, ..SURFACE };
    let error = system().with_striker(striker(surface)).expect_err("refused");
    assert!(matches!(error, SystemError::Floor { parameter: "normal_stiffness", .. }), "{error}");
    let twice =
        system().with_striker(striker(SURFACE)).and_then(|s| s.with_striker(striker(SURFACE)));
    assert_eq!(twice.expect_err("refused"), SystemError::Striker { striker: 1 });
}

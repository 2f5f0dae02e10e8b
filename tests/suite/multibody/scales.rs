//! Residuals are measured by each equation's own inertia and the motion's energy: a motion is the same in any units,
//! in any frame that drifts, and after a step that failed.

use nalgebra::Vector3;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use surefoot::spatial::Quaternion;
use surefoot_mechanics::integrators::YOSHIDA_4;
use surefoot_multibody::{
    Body, BodyState, Closing, Closure, ConstrainedSimulation, Joint, JointConstraint, JointLaw,
    Link, PlanarSimulation, Simulation, SingleBody, System,
};

/// Units in which the same motion is described.
#[derive(Clone, Copy, Debug)]
struct Units {
    m: f64,
    kg: f64,
    s: f64,
}

const ONE: Units = Units { m: 1.0, kg: 1.0, s: 1.0 };

/// Sizes from a micrometre to a thousand kilometres, masses likewise, rates from 1e-9 to 1e9 rad/s.
const ALL: [Units; 6] = [
    Units { m: 1e-6, kg: 1e-6, s: 1.0 },
    Units { m: 1e6, kg: 1e6, s: 1.0 },
    Units { m: 1.0, kg: 1.0, s: 1e9 },
    Units { m: 1.0, kg: 1.0, s: 1e-9 },
    Units { m: 1e-6, kg: 1e6, s: 1e6 },
    Units { m: 1e6, kg: 1e-6, s: 1e-6 },
];

/// Steps, in units of time.
const STEP: f64 = 0.01;

/// A system that floats without gravity, with a start.
struct Start {
    system: System,
    states: Vec<BodyState>,
    rates: Vec<BodyState>,
    /// Motors, by link.
    torques: Vec<f64>,
}

/// What a system is to have.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Sort {
    /// One free body of three different moments.
    Body,
    /// All joint kinds.
    Tree,
    /// Axes across a plane, springs, dampers and motors.
    Planar,
    /// The same as a loop of five bars, which spins as a whole.
    Loop,
}

/// A random system whose centre of mass drifts by so much, in units of length and time; with it at rest, it spins.
fn start(sort: Sort, seed: u64, units: Units, drift: [f64; 3]) -> Start {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut number = move |low: f64, high: f64| random.random_range(low..high);
    let is_flat = matches!(sort, Sort::Planar | Sort::Loop);
    let bodies = if sort == Sort::Body { 1 } else { 5 };
    let normal = Vector3::y();
    let mut point = |x: f64| {
        let [a, b, c] = [number(-x, x), number(-x, x), number(-x, x)];
        Vector3::new(a, if is_flat { 0.0 } else { b }, c)
    };
    let (mut links, mut all) = (Vec::<Link>::new(), Vec::<[Vector3<f64>; 3]>::new());
    let mut turns: Vec<Quaternion<f64>> = Vec::new();
    let (mut laws, mut torques) = (Vec::new(), vec![0.0; bodies]);
    let spin = if is_flat { normal * 1.3 } else { Vector3::new(0.9, -0.6, 1.1) };
    let mut first = Vector3::zeros();
    for k in 0..bodies {
        let about = if is_flat { normal } else { point(1.0).normalize() };
        let turn = Quaternion::from_axis_angle(about, point(2.0).x);
        let (center, at) = (point(0.4), point(0.4));
        let inboard = k.checked_sub(if k > 2 && !is_flat { 2 } else { 1 });
        let (x_i, v_i, omega_i, turn_i) = match inboard {
            Some(i) => (all[i][0], all[i][1], all[i][2], turns[i]),
            None => (Vector3::zeros(), spin.cross(&center), spin, Quaternion::identity()),
        };
        // A loop spins as a whole: its joints stand still, and so do its ends against one another.
        let rate = if sort == Sort::Loop { 0.0 } else { point(0.5).x };
        let (a, b) = if is_flat { (normal, normal) } else { (Vector3::x(), Vector3::z()) };
        let in_body = |turn: &Quaternion<f64>, v: Vector3<f64>| turn.conjugate().rotate(v).into();
        let shift = v_i + omega_i.cross(&(at - x_i));
        let (constraint, omega, v) = match (k, is_flat) {
            (0, _) => (JointConstraint::Floating, spin, v_i),
            (2, false) => (JointConstraint::Spherical, omega_i + (a - b) * rate, shift),
            (3, false) => {
                let constraint = JointConstraint::Universal {
                    outboard_axis: in_body(&turn, b),
                    inboard_axis: in_body(&turn_i, a),
                };
                (constraint, omega_i + a * rate - b * rate, shift)
            }
            (4, false) => (
                JointConstraint::Prismatic { axis: in_body(&turn_i, a) },
                omega_i,
                shift + a * rate,
            ),
            _ => (JointConstraint::Revolute { axis: in_body(&turn, a) }, omega_i + a * rate, shift),
        };
        let v = if k == 0 { v } else { v + omega.cross(&(center - at)) };
        let mass = 0.5 + point(0.4).x.abs();
        let (moments, axes) = ([0.02, 0.05, 0.035], [0.9, 1.0, 1.1]);
        let inertia: [f64; 3] = std::array::from_fn(|i| mass * moments[i] * axes[i]);
        let body = Body {
            mass: mass * units.kg,
            inertia: inertia.map(|i| i * units.kg * units.m * units.m),
        };
        let arm = |turn: &Quaternion<f64>, from: Vector3<f64>| -> [f64; 3] {
            in_body(turn, (at - from) * units.m)
        };
        let is_root = inboard.is_none();
        let joint = Joint {
            outboard: if is_root { [0.0; 3] } else { arm(&turn, center) },
            inboard: if is_root { [0.0; 3] } else { arm(&turn_i, x_i) },
            home: if is_root {
                [1.0, 0.0, 0.0, 0.0]
            } else {
                turn_i.conjugate().product(turn).to_array()
            },
            constraint,
        };
        if k == 0 {
            first = center;
        }
        if let JointConstraint::Revolute { .. } = constraint {
            let moment = units.kg * units.m * units.m / (units.s * units.s);
            laws.push((
                k,
                JointLaw {
                    stiffness: 0.1 * moment,
                    rest: 0.3,
                    damping: 0.02 * moment * units.s,
                    rotor_inertia: 0.01 * units.kg * units.m * units.m,
                    ..JointLaw::NONE
                },
            ));
            torques[k] = 0.01 * moment;
        }
        links.push(Link { inboard, joint, body });
        all.push([center, v, omega]);
        turns.push(turn);
    }
    let mass: f64 = links.iter().map(|link| link.body.mass).sum();
    let momentum: Vector3<f64> =
        links.iter().zip(&all).map(|(link, [_, v, _])| v * link.body.mass).sum();
    let by = Vector3::from(drift) - momentum / mass;
    let speed = units.m / units.s;
    let whole = |p: Vector3<f64>, [s, i, j, k]: [f64; 4]| [p.x, p.y, p.z, s, i, j, k];
    let states = all.iter().zip(&turns).map(|([x, ..], q)| whole(x * units.m, q.to_array()));
    let rates = all.iter().zip(&turns).map(|([_, v, omega], q)| {
        let rate = q.rate(q.conjugate().rotate(*omega / units.s)).to_array();
        whole((v + by) * speed, rate)
    });
    let (states, rates) = (states.collect(), rates.collect());
    let mut system = System::new(links, 0.0).expect("a system");
    for (link, law) in laws {
        system = system.with_law(link, law).expect("a law");
    }
    if sort == Sort::Loop {
        let last = bodies - 1;
        let at = (all[last][0] + first) * 0.5;
        let arm = |k: usize| -> [f64; 3] {
            turns[k].conjugate().rotate((at - all[k][0]) * units.m).into()
        };
        let axis = turns[last].conjugate().rotate(normal).into();
        let joint = Joint {
            outboard: arm(last),
            inboard: arm(0),
            home: turns[0].conjugate().product(turns[last]).to_array(),
            constraint: JointConstraint::Revolute { axis },
        };
        let closing = Closing::Joint(joint);
        let closure = Closure { outboard: last, inboard: Some(0), closing };
        system = system.with_closure(closure).expect("a loop");
    }
    Start { system, states, rates, torques }
}

/// The engines.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Engine {
    Space,
    Stages,
    Plane,
    Single,
    Oracle,
}

/// States after so many steps, in units of length, and Newton iterations a step.
fn played(engine: Engine, start: &Start, units: Units, steps: usize) -> (Vec<BodyState>, f64) {
    let Start { system, states, rates, torques } = start;
    let (system, h) = (system.clone(), STEP * units.s);
    let (states, iterations) = match engine {
        Engine::Space | Engine::Stages => {
            let mut motion = Simulation::new(system, h, states, rates).expect("a start");
            (0..torques.len()).for_each(|k| motion.set_torque(k, torques[k]));
            for _ in 0..steps {
                match engine {
                    Engine::Space => motion.step(),
                    _ => motion.step_in_stages(&YOSHIDA_4),
                }
                .expect("a step");
            }
            (motion.states(), motion.progress().mean_iterations())
        }
        Engine::Plane => {
            let mut motion = PlanarSimulation::new(system, h, states, rates).expect("a plane");
            (0..torques.len()).for_each(|k| motion.set_torque(k, torques[k]));
            (0..steps).for_each(|_| motion.step().expect("a step"));
            (motion.states(), motion.progress().mean_iterations())
        }
        Engine::Single => {
            let mut motion = SingleBody::new(system, h, states, rates).expect("a body");
            (0..steps).for_each(|_| motion.step().expect("a step"));
            (vec![motion.state()], motion.progress().mean_iterations())
        }
        Engine::Oracle => {
            let (states, rates) = (states.clone(), rates.clone());
            let mut motion = ConstrainedSimulation::new(system, h, states, rates).expect("a start");
            (0..steps).for_each(|_| motion.step().expect("a step"));
            (motion.states().to_vec(), motion.progress().mean_iterations())
        }
    };
    let in_units =
        |x: BodyState| std::array::from_fn(|i| if i < 3 { x[i] / units.m } else { x[i] });
    (states.into_iter().map(in_units).collect(), iterations)
}

/// Largest difference, positions against those of the first bodies.
fn apart(a: &[BodyState], b: &[BodyState]) -> f64 {
    let mut largest = 0.0_f64;
    for (x, y) in a.iter().zip(b) {
        for i in 0..7 {
            let (from_a, from_b) = if i < 3 { (a[0][i], b[0][i]) } else { (0.0, 0.0) };
            largest = largest.max(((x[i] - from_a) - (y[i] - from_b)).abs());
        }
    }
    largest
}

const PAIRS: [(Sort, Engine); 9] = [
    (Sort::Body, Engine::Single),
    (Sort::Body, Engine::Space),
    (Sort::Body, Engine::Oracle),
    (Sort::Tree, Engine::Space),
    (Sort::Tree, Engine::Stages),
    (Sort::Planar, Engine::Space),
    (Sort::Planar, Engine::Plane),
    (Sort::Loop, Engine::Space),
    (Sort::Loop, Engine::Stages),
];

/// Whatever spins about a resting centre of mass does so in all units alike, at the cost of the same iterations.
#[test]
fn motions_are_the_same_in_all_units() {
    for (sort, engine) in PAIRS {
        let (mut largest, mut most) = (0.0_f64, 0.0_f64);
        for seed in 0..4 {
            let one = played(engine, &start(sort, seed, ONE, [0.0; 3]), ONE, 300);
            for units in ALL {
                let other = played(engine, &start(sort, seed, units, [0.0; 3]), units, 300);
                largest = largest.max(apart(&one.0, &other.0));
                most = most.max((other.1 / one.1 - 1.0).abs());
            }
        }
        println!("{sort:?}, {engine:?}: apart by {largest:.1e}, iterations by {most:.1e}");
        // 8.6e-14 and 6.5e-3 at most.
        assert!(largest < 5e-13, "{sort:?}, {engine:?}: {largest}");
        assert!(most < 0.02, "{sort:?}, {engine:?}: {most}");
    }
}

/// A drift of the whole costs no more than its round-off: of positions that grow, and of momenta that are added up.
#[test]
fn motions_know_no_drift() {
    for (sort, engine) in PAIRS {
        for drift in [1.0, 1e3, 1e6] {
            let mut largest = 0.0_f64;
            for seed in 0..4 {
                let still = played(engine, &start(sort, seed, ONE, [0.0; 3]), ONE, 300).0;
                let along = [drift, if sort == Sort::Body { -drift } else { 0.0 }, 0.5 * drift];
                let moving = played(engine, &start(sort, seed, ONE, along), ONE, 300).0;
                largest = largest.max(apart(&still, &moving));
            }
            println!("{sort:?}, {engine:?}, {drift:e} m/s: apart by {largest:.1e}");
            // 2.3e-13 of the drift at most, of 1 in units of length and time: some thousand round-offs, in 300 steps.
            assert!(largest < 1e-12 * drift, "{sort:?}, {engine:?}, {drift}: {largest}");
        }
    }
}

/// A step that fails leaves no trace: not in the tolerance of the next one either.
#[test]
fn a_step_that_failed_leaves_no_trace() {
    for sort in [Sort::Tree, Sort::Planar, Sort::Loop] {
        let Start { system, states, rates, torques } = start(sort, 1, ONE, [0.0; 3]);
        let mut space = Simulation::new(system.clone(), STEP, &states, &rates).expect("a start");
        (0..20).for_each(|_| space.step().expect("a step"));
        let mut other = space.clone();
        space.set_torque(1, 1e30);
        space.step().expect_err("a torque beyond all bounds");
        space.set_torque(1, torques[1]);
        other.set_torque(1, torques[1]);
        for _ in 0..20 {
            space.step().expect("a step");
            other.step().expect("a step");
        }
        assert_eq!(space.states(), other.states(), "{sort:?}");
        if sort != Sort::Planar {
            continue;
        }
        let mut plane = PlanarSimulation::new(system, STEP, &states, &rates).expect("a plane");
        let mut other = plane.clone();
        plane.set_torque(1, 1e30);
        plane.step().expect_err("a torque beyond all bounds");
        plane.set_torque(1, 0.0);
        for _ in 0..20 {
            plane.step().expect("a step");
            other.step().expect("a step");
        }
        assert_eq!(plane.states(), other.states());
    }
}

/// The closed form of a free symmetric top: about its axis and about its angular momentum at constant rates, down to
/// a turn in two hundred years.
#[test]
fn a_creeping_top_precesses() {
    for slow in [1.0, 1e-3, 1e-9] {
        let units = Units { s: 1.0 / slow, ..ONE };
        let (i1, i3) = (0.3, 0.5);
        let mut of_body = start(Sort::Body, 0, units, [0.0; 3]);
        let [link] = of_body.system.links() else { unreachable!("one body") };
        let body = Body { mass: 1.0, inertia: [i1, i1, i3] };
        let joint = Joint { home: [1.0, 0.0, 0.0, 0.0], ..link.joint };
        of_body.system = System::new(vec![Link { body, joint, ..*link }], 0.0).expect("a body");
        let omega = Vector3::new(0.4, 0.0, 0.7);
        let rate = Quaternion::identity().rate(omega * slow).to_array();
        of_body.states = vec![[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]];
        of_body.rates = vec![[0.0, 0.0, 0.0, rate[0], rate[1], rate[2], rate[3]]];
        let spin = Vector3::new(i1 * omega.x, 0.0, i3 * omega.z);
        let (time, steps) = (STEP * 1000.0, 1000);
        let about = |axis: Vector3<f64>, angle: f64| Quaternion::from_axis_angle(axis, angle);
        let precession = about(spin.normalize(), spin.norm() / i1 * time);
        let right = precession.product(about(Vector3::z(), (1.0 - i3 / i1) * omega.z * time));
        for engine in [Engine::Single, Engine::Space, Engine::Oracle] {
            let found = played(engine, &of_body, units, steps).0[0];
            let q = Quaternion::from_array([found[3], found[4], found[5], found[6]]);
            let off = 2.0 * right.conjugate().product(q).v.norm();
            // 8.4e-5, all engines alike: the phase of a method of second order.
            println!("{engine:?}, {slow:e}: off by {off:.2e} rad");
            assert!(off < 1.5e-4, "{engine:?}, {slow}: {off}");
        }
    }
}

/// Springs that hold one another: at rest they stay, though no momentum is there to measure anything by.
#[test]
fn what_rests_between_springs_stays() {
    for stiff in [1e-6, 1.0, 1e9] {
        let joint = |axis| Joint {
            outboard: [0.0; 3],
            inboard: [0.0; 3],
            home: [1.0, 0.0, 0.0, 0.0],
            constraint: JointConstraint::Prismatic { axis },
        };
        let body = Body { mass: 1.0, inertia: [0.1; 3] };
        let links = vec![
            Link { inboard: None, joint: joint([1.0, 0.0, 0.0]), body },
            Link { inboard: Some(0), joint: joint([1.0, 0.0, 0.0]), body },
        ];
        let law = |rest: f64| JointLaw { stiffness: stiff, rest, ..JointLaw::NONE };
        let system = System::new(links, 0.0).expect("a tree");
        let system = system.with_law(0, law(0.3)).expect("a law").with_law(1, law(-0.1)).expect("");
        let at = |x: f64| [x, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
        let states = [at(0.3), at(0.2)];
        let mut motion = Simulation::new(system, 1e-3, &states, &[[0.0; 7]; 2]).expect("a start");
        (0..100).for_each(|_| motion.step().expect("a step"));
        for (x, start) in motion.states().iter().zip(&states) {
            assert!((x[0] - start[0]).abs() < 1e-12, "{stiff}: {}", x[0]);
        }
    }
}

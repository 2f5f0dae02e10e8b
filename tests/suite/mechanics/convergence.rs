//! Orders of convergence, against solutions in quadruple precision by other software.

use serde_json::Value;
use surefoot_sim::integrators::{
    Composition, EnergyMomentum, Rattle, RungeKutta, Variational, YOSHIDA_4, YOSHIDA_6,
};
use surefoot_sim::mechanics::systems::{DoubleSphericalPendulum, FreeRigidBody};
use surefoot_sim::mechanics::{DiscreteLagrangian, Endpoint, Midpoint};

const PENDULUM: DoubleSphericalPendulum = DoubleSphericalPendulum::PRINTED;

fn reference(state: &str, names: &[&str]) -> Vec<f64> {
    let text = include_str!("../../vectors/integrator_reference.json");
    let file: Value = serde_json::from_str(text).expect("JSON");
    // Written as text, to keep all digits.
    let of = |name: &&str| file["reference_state"][state][*name].as_str().expect("a number");
    names.iter().map(|name| of(name).parse().expect("a number")).collect()
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| (x - y).powi(2)).sum::<f64>().sqrt()
}

/// Errors over a decade of steps fall with the second power of the step.
fn assert_second_order(what: &str, error: impl Fn(usize) -> f64) {
    assert_order(what, 2.0, 0.02, [1000, 2000, 4000, 10_000], error);
}

/// Errors fall with a power of the step.
fn assert_order(
    what: &str,
    expected: f64,
    tolerance: f64,
    steps: [usize; 4],
    error: impl Fn(usize) -> f64,
) {
    let errors = steps.map(&error);
    for ((coarse, fine), (n, m)) in
        errors.iter().zip(&errors[1..]).zip(steps.iter().zip(&steps[1..]))
    {
        let order = (coarse / fine).ln() / (*m as f64 / *n as f64).ln();
        println!("{what}: from {n} to {m} steps a second: order {order:.4}");
        assert!((order - expected).abs() < tolerance, "{what}: order {order}");
    }
}

fn pendulum(
    system: impl DiscreteLagrangian<6, 2> + Copy,
    seconds: usize,
    per_second: usize,
) -> [f64; 6] {
    let (q, v) = PENDULUM.printed_start();
    let h = 1.0 / per_second as f64;
    let mut motion = Variational::<_, 6, 2, 8>::from_velocity(system, h, q, v);
    for _ in 0..seconds * per_second {
        motion.step().expect("a step");
    }
    *motion.configuration()
}

const POSITIONS: [&str; 6] = ["x1", "y1", "z1", "x2", "y2", "z2"];

#[test]
fn second_order_methods_are_of_second_order() {
    for (seconds, state) in [(1, "DSP_t1"), (5, "DSP_t5")] {
        let exact = reference(state, &POSITIONS);
        assert_second_order("pendulum, Midpoint", |n| {
            distance(&pendulum(Midpoint(PENDULUM), seconds, n), &exact)
        });
        assert_second_order("pendulum, Endpoint", |n| {
            distance(&pendulum(Endpoint(PENDULUM), seconds, n), &exact)
        });
        assert_second_order("pendulum, energy-momentum", |n| {
            let (q, v) = PENDULUM.printed_start();
            let mut motion = EnergyMomentum::<_, 6, 2, 8>::new(PENDULUM, 1.0 / n as f64, q, &v);
            for _ in 0..seconds * n {
                motion.step().expect("a step");
            }
            distance(motion.configuration(), &exact)
        });
    }
    for (seconds, state) in [(1, "RB_t1"), (5, "RB_t5")] {
        let exact = reference(state, &["q_s", "q_x", "q_y", "q_z"]);
        assert_second_order("rigid body", |n| {
            let rate = [0.0, 0.0, 1.5, 2.0];
            let q = [1.0, 0.0, 0.0, 0.0];
            let h = 1.0 / n as f64;
            let mut motion =
                Variational::<_, 4, 1, 5>::from_velocity(FreeRigidBody::PRINTED, h, q, rate);
            for _ in 0..seconds * n {
                motion.step().expect("a step");
            }
            distance(motion.configuration(), &exact)
        });
    }
}

fn composed(stages: &'static [f64], seconds: usize, per_second: usize) -> [f64; 6] {
    let (q, v) = PENDULUM.printed_start();
    let h = 1.0 / per_second as f64;
    let mut motion = Composition::<_, 6, 2, 8>::new(Midpoint(PENDULUM), stages, h, q, v);
    for _ in 0..seconds * per_second {
        motion.step().expect("a step");
    }
    *motion.configuration()
}

#[test]
fn compositions_are_of_their_order() {
    for (seconds, state) in [(1, "DSP_t1"), (5, "DSP_t5")] {
        let exact = reference(state, &POSITIONS);
        assert_order("pendulum, Yoshida 4", 4.0, 0.1, [100, 200, 400, 1000], |n| {
            distance(&composed(&YOSHIDA_4, seconds, n), &exact)
        });
        assert_order("pendulum, Yoshida 6", 6.0, 0.3, [25, 40, 60, 80], |n| {
            distance(&composed(&YOSHIDA_6, seconds, n), &exact)
        });
    }
    let exact = reference("RB_t5", &["q_s", "q_x", "q_y", "q_z"]);
    assert_order("rigid body, Yoshida 4", 4.0, 0.1, [100, 200, 400, 1000], |n| {
        let (q, rate) = ([1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.5, 2.0]);
        let h = 1.0 / n as f64;
        let mut motion =
            Composition::<_, 4, 1, 5>::new(FreeRigidBody::PRINTED, &YOSHIDA_4, h, q, rate);
        for _ in 0..5 * n {
            motion.step().expect("a step");
        }
        distance(motion.configuration(), &exact)
    });
}

/// Velocities, too: RATTLE's are on the manifold's tangent space.
#[test]
fn rattle_and_runge_kutta_are_of_their_order() {
    const ALL: [&str; 12] =
        ["x1", "y1", "z1", "x2", "y2", "z2", "vx1", "vy1", "vz1", "vx2", "vy2", "vz2"];
    let (q, v) = PENDULUM.printed_start();
    for (seconds, state) in [(1, "DSP_t1"), (5, "DSP_t5")] {
        let exact = reference(state, &ALL);
        assert_second_order("pendulum, RATTLE", |n| {
            let mut motion = Rattle::<_, 6, 2>::new(PENDULUM, 1.0 / n as f64, q, &v);
            for _ in 0..seconds * n {
                motion.step().expect("a step");
            }
            distance(&[*motion.configuration(), motion.velocity()].concat(), &exact)
        });
        assert_order("pendulum, Runge–Kutta", 4.0, 0.15, [100, 200, 400, 1000], |n| {
            let mut motion = RungeKutta::<_, 6, 2>::new(PENDULUM, 1.0 / n as f64, q, v);
            for _ in 0..seconds * n {
                motion.step().expect("a step");
            }
            distance(&[*motion.configuration(), *motion.velocity()].concat(), &exact)
        });
    }
}

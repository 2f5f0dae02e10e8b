//! Orders of convergence of every method, against solutions in quadruple precision by other software
//! and against Kepler's ellipse.

use super::systems::{body, pendulum, planet, planet_at};
use serde_json::Value;
use surefoot_mechanics::integrators::{Method, Motion, StartError};

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

const STATE: [&str; 12] =
    ["x1", "y1", "z1", "x2", "y2", "z2", "vx1", "vy1", "vz1", "vx2", "vy2", "vz2"];
const QUATERNION: [&str; 4] = ["q_s", "q_x", "q_y", "q_z"];

/// Steps a second over a decade, by a method's order, and how near to that order their errors fall.
fn decade(order: u32) -> ([usize; 4], f64) {
    match order {
        1 => ([20_000, 40_000, 80_000, 200_000], 0.02),
        2 => ([1000, 2000, 4000, 10_000], 0.02),
        4 => ([150, 300, 600, 1500], 0.1),
        // Smaller errors than those at 80 are round-off's.
        _ => ([25, 40, 60, 80], 0.3),
    }
}

/// Errors in configuration, and in velocity where the reference has it, of a motion of some seconds.
fn assert_order<const N: usize>(
    what: &str,
    method: Method,
    seconds: usize,
    exact: &[f64],
    start: impl Fn(Method, f64) -> Result<Motion<N>, StartError>,
) {
    let error = |per_second: usize| {
        let mut motion = start(method, 1.0 / per_second as f64).expect("a start");
        for _ in 0..seconds * per_second {
            motion.step().expect("a step");
        }
        let velocity = motion.velocity().expect("a velocity");
        let state = [*motion.configuration(), velocity].concat();
        [distance(&state[..N], &exact[..N]), distance(&state[N..], &exact[N..])]
    };
    let order = match method {
        // For natural Lagrangians only it is of second order (§2.3.5).
        Method::VariationalEndpoint if what.starts_with("free body") => Some(1),
        _ => method.order(),
    };
    let Some(order) = order else {
        let [error, _] = error(10);
        println!("{what}, {method}: error {error:.1e}");
        assert!(error < 1e-9, "{what}, {method}: error {error}");
        return;
    };
    let (steps, tolerance) = decade(order);
    // The planet is slower, and rounds off earlier.
    let steps = match order {
        6 => steps,
        _ if what.starts_with("planet") => steps.map(|n| n / 5),
        _ => steps,
    };
    let errors = steps.map(error);
    let parts = if exact.len() > N { 2 } else { 1 };
    for k in 0..parts {
        let last = steps.len() - 1;
        let ratio = errors[0][k] / errors[last][k];
        let slope = ratio.ln() / (steps[last] as f64 / steps[0] as f64).ln();
        println!("{what}, {method}, {}: order {slope:.4}", ["configuration", "velocity"][k]);
        assert!((slope - f64::from(order)).abs() < tolerance, "{what}, {method}: order {slope}");
    }
}

#[test]
fn every_method_is_of_its_order_on_the_double_pendulum() {
    for method in Method::all() {
        if matches!(method, Method::Verlet | Method::LieGroup) {
            assert!(matches!(pendulum(*method, 0.01), Err(StartError::NotFor { .. })));
            continue;
        }
        assert_order("pendulum, 1 s", *method, 1, &reference("DSP_t1", &STATE), pendulum);
        if method.order() != Some(1) {
            assert_order("pendulum, 5 s", *method, 5, &reference("DSP_t5", &STATE), pendulum);
        }
    }
}

#[test]
fn every_method_is_of_its_order_on_the_free_body() {
    for method in Method::all() {
        if body(*method, 0.01).is_err() {
            continue;
        }
        assert_order("free body, 1 s", *method, 1, &reference("RB_t1", &QUATERNION), body);
        if method.order() != Some(1) {
            assert_order("free body, 5 s", *method, 5, &reference("RB_t5", &QUATERNION), body);
        }
    }
}

#[test]
fn every_method_is_of_its_order_on_a_planet() {
    let exact = planet_at(0.3, 4.0);
    for method in Method::all() {
        if *method != Method::LieGroup {
            assert_order("planet, 4 s", *method, 4, &exact, planet);
        }
    }
}

//! The energy that is reported is the system's, under every method: bodies, weight, and all that joints hold.

use surefoot_mechanics::integrators::{Method, StartError};
use surefoot_sim::mechanism::{MechanismRun, StartFailure, run};
use surefoot_sim::scene::{AnyScene, parse};

const METHODS: [Method; 6] = [
    Method::Variational,
    Method::Yoshida4,
    Method::Yoshida6,
    Method::SemiImplicitEuler,
    Method::RungeKutta4,
    Method::DormandPrince8,
];

const MASS: f64 = 2.0;
const GRAVITY: f64 = 9.81;
const ANGLE: f64 = 0.9;
const RATE: f64 = 1.5;

/// A wheel on a hinge, its centre of mass beside it or on it, and a slide along the axis; with laws of both.
fn played(
    method: Method,
    beside: f64,
    hinge: &str,
    slide: &str,
) -> Result<MechanismRun, StartFailure> {
    let (x, z) = (beside * ANGLE.sin(), beside * ANGLE.cos());
    let text = format!(
        r#"
description = "a wheel with a slide"
duration_s = 0.5
[integrator]
name = "{method}"
step_s = 2e-4
[mechanism]
kind = "multibody"
gravity_m_s2 = {GRAVITY}
[[mechanism.bodies]]
name = "wheel"
mass_kg = {MASS}
inertia_kg_m2 = [0.1, 0.1, 0.1]
center_m = [{x}, 0.0, {z}]
joint = {{ kind = "revolute", point_m = [0.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0], rate_rad_s = {RATE} }}
law = {{ {hinge} }}
[[mechanism.bodies]]
name = "slide"
inboard = "wheel"
mass_kg = 0.5
inertia_kg_m2 = [0.01, 0.01, 0.01]
center_m = [0.0, 0.0, 0.0]
joint = {{ kind = "prismatic", axis = [0.0, 1.0, 0.0] }}
law = {{ {slide} }}
"#
    );
    let AnyScene::Mechanism(scene) = parse("test", &text).expect("a scene") else { unreachable!() };
    run(&scene, &mut |_| {})
}

/// What the system has at the start, J, without its springs.
fn of_bodies(beside: f64) -> f64 {
    let inertia = 0.1 + 0.01 + MASS * beside * beside;
    0.5 * inertia * RATE * RATE + MASS * GRAVITY * beside * ANGLE.cos()
}

/// At the start to round-off, and at the end as far as the method goes: 1.3e-3 of it for Euler's, of first order.
#[test]
fn springs_are_in_the_energy_of_every_method() {
    let (k, rest, k_slide, rest_slide) = (3.0, 0.4, 50.0, -0.1);
    let springs = [
        (format!("stiffness = {k}, rest = {rest}"), 0.5 * k * rest * rest),
        (
            format!("stiffness = {k_slide}, rest = {rest_slide}"),
            0.5 * k_slide * rest_slide * rest_slide,
        ),
    ];
    for method in METHODS {
        for beside in [0.0, 0.2] {
            for (hinge, slide) in [(true, false), (false, true), (true, true)] {
                let of =
                    |on: bool, k: usize| if on { springs[k].0.as_str() } else { "stiffness = 0.0" };
                let held = f64::from(hinge) * springs[0].1 + f64::from(slide) * springs[1].1;
                let run = played(method, beside, of(hinge, 0), of(slide, 1)).expect("a run");
                assert_eq!(run.failure, None, "{method}");
                let start = of_bodies(beside) + held;
                let first = run.samples[0].energy;
                assert!(
                    (first - start).abs() < 1e-13 * start,
                    "{method}: {first} J, right {start} J"
                );
                let [low, high] = run.energy_range;
                let bound = if method == Method::SemiImplicitEuler { 4e-3 } else { 1e-5 };
                println!(
                    "{method}, {beside} m, {hinge} {slide}: band {:.1e}",
                    (high - low) / start
                );
                assert!(high - low < bound * start, "{method}: {low} to {high} J");
                assert!(run.keeps_energy && !run.has_lost_energy());
            }
        }
    }
}

/// What a damper takes is gone: energy falls, in every method alike.
#[test]
fn dampers_take_energy_in_every_method() {
    let mut all = Vec::new();
    for method in METHODS {
        let law = "stiffness = 3.0, rest = 0.4, damping = 0.2";
        let run = played(method, 0.2, law, "stiffness = 50.0, rest = -0.1, damping = 1.0");
        let run = run.expect("a run");
        let energies: Vec<f64> = run.samples.iter().map(|sample| sample.energy).collect();
        assert!(energies.is_sorted_by(|a, b| a > b), "{method}");
        assert!(!run.keeps_energy);
        all.push(energies[energies.len() - 1]);
    }
    // 1.4e-3 J apart for Euler's method of first order, 5e-8 J at most for the others.
    println!("{all:?}");
    let apart = |k: usize| (all[k] - all[5]).abs();
    assert!((0..6).all(|k| apart(k) < if k == 3 { 3e-3 } else { 1e-7 }), "{all:?}");
}

/// A stop's energy counts while it yields; methods on differential equations refuse stops by name.
#[test]
fn stops_are_in_the_energy_of_every_method_that_has_them() {
    for method in METHODS {
        let run = played(
            method,
            0.0,
            "stops = { low = -0.1, high = 0.2, stiffness = 20.0 }",
            "stiffness = 0.0",
        );
        let run = match run {
            Ok(run) => run,
            Err(StartFailure::Method(StartError::NotFor { method: named, takes })) => {
                assert_eq!((named, takes), (method, "joints without stops"));
                assert!(!matches!(method, Method::Variational | Method::Yoshida4));
                continue;
            }
            Err(error) => panic!("{method}: {error}"),
        };
        let (first, [low, high]) = (run.samples[0].energy, run.energy_range);
        assert!((first - of_bodies(0.0)).abs() < 1e-13, "{first}");
        println!("{method}: band {:.1e} J of {first} J", high - low);
        assert!(high - low < 1e-4 * first, "{method}: {low} to {high}");
    }
}

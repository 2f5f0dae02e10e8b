//! Against `vectors/walk_vectors.json`: a planner in Python, of the same sources, made by others.

use super::{FEET, about_z, foot, nowhere, number, numbers, planner, vector};
use nalgebra::Vector2;
use serde_json::Value;
use surefoot::Real;
use surefoot::balance::{AngularTask, FootTask, LinearTask, ObservedMotion};
use surefoot::walk::{
    Phase, PlaneMotion, Side, StepQuery, WalkCommand, WalkMemory, next_step, periodic_step,
};
use surefoot_tests::vectors::{array, walk};

fn name(of: &Value) -> &'static str {
    if of["points"].as_bool().expect("a flag") { "pairs" } else { "soles" }
}

/// Largest difference, m and s, of all steps.
fn steps<T: Real>() -> f64 {
    let mut worst = 0.0_f64;
    let gaits = [planner::<T>("soles").gait, planner::<T>("pairs").gait];
    for row in walk()["steps"].as_array().expect("steps") {
        let gait = gaits[usize::from(name(row) == "pairs")];
        let side = if number(&row["side"]) > 0.0 { Side::Left } else { Side::Right };
        let pair = |key: &str| Vector2::from(array::<2>(&row[key])).map(T::of);
        let query = StepQuery {
            side,
            offset: pair("offset"),
            velocity: pair("velocity"),
            elapsed: T::of(number(&row["elapsed"])),
            swinging: pair("swinging"),
        };
        let periodic = periodic_step(&gait, side, query.velocity);
        let step = next_step(&gait, &query);
        let [p, a, b] = [periodic.step, periodic.at_touch_down, periodic.at_lift_off];
        let ours = [p.x, p.y, a.x, a.y, b.x, b.y, periodic.kappa, periodic.growth];
        let ours = ours.into_iter().chain([step.left, step.step.x, step.step.y]);
        let ours = ours.chain([step.miss.x, step.miss.y]).map(Real::to_f64);
        let theirs = numbers(&row["nominal"]).into_iter().chain([number(&row["left"])]);
        let theirs = theirs.chain(numbers(&row["step"])).chain(numbers(&row["miss"]));
        worst = ours.zip(theirs).map(|(x, y)| (x - y).abs()).fold(worst, f64::max);
    }
    worst
}

#[test]
fn steps_are_chosen_as_in_python() {
    // Measured: f64 2e-16 … 2e-15, f32 2e-6.
    let (double, single) = (steps::<f64>(), steps::<f32>());
    assert!(double < 1e-14, "{double:e}");
    assert!(single < 1e-5, "{single:e}");
}

fn observed(tick: &Value) -> ObservedMotion<f64, FEET> {
    let com = array::<6>(&tick["com"]);
    let feet = tick["feet"].as_array().expect("feet");
    let yaws = numbers(&tick["yaw_feet"]);
    ObservedMotion {
        center_of_mass: vector([com[0], com[1], com[2]]),
        velocity: vector([com[3], com[4], com[5]]),
        angular_momentum: vector(array(&tick["momentum"])),
        central_rotation: about_z(number(&tick["yaw"])),
        angular_velocity: vector(array(&tick["rate"])),
        feet: std::array::from_fn(|k| match feet.get(k) {
            Some(of) => {
                let of = numbers(of);
                let velocity = std::array::from_fn(|i| of[3 + i]);
                foot([of[0], of[1], of[2]], velocity, yaws[k], array(&tick["legs"][k]))
            }
            None => nowhere(),
        }),
    }
}

/// Runs one of the walks; the largest differences of steps (m, s), of pressures and accelerations of the whole, and of
/// accelerations of feet, relative to 1.
fn walked(walk: &Value) -> [f64; 3] {
    let planner = planner::<f64>(name(walk));
    let dt = number(&walk["dt"]);
    let mut memory = WalkMemory::standing(0.0);
    let mut worst = [0.0_f64; 3];
    let mut before = "stand";
    let mut see = |kind: usize, x: f64, y: f64, what: &str, tick: usize| {
        let off = (x - y).abs() / y.abs().max(1.0);
        assert!(off < 1e-3, "{what} at tick {tick}: {x} instead of {y}");
        worst[kind] = worst[kind].max(off);
    };
    for (at, tick) in walk["ticks"].as_array().expect("ticks").iter().enumerate() {
        let command = tick["command"].as_array().map(|_| {
            let [x, y, turning_rate] = array(&tick["command"]);
            PlaneMotion { velocity: Vector2::new(x, y), turning_rate }
        });
        let command = WalkCommand { walk: command, ..WalkCommand::stand() };
        let mut forces = [0.0; FEET];
        forces.iter_mut().zip(numbers(&tick["forces"])).for_each(|(to, x)| *to = x);
        let seen = observed(tick);
        let task = planner.plan(&mut memory, &seen, &forces, &command, dt).expect("a plan");
        let mode = tick["mode"].as_str().expect("a mode");
        let (ours, left, step) = match memory.phase {
            Phase::Standing => ("stand", 0.0, Vector2::zeros()),
            Phase::Single { step, .. } => ("ss", step.left, step.step),
            Phase::Double { .. } => ("ds", 0.0, Vector2::zeros()),
            Phase::Jump(_) | Phase::Run(_) => panic!("no leap"),
        };
        assert_eq!(ours, mode, "at tick {at}");
        let [x, y] = array(&tick["step"]);
        see(0, left, number(&tick["left"]), "time left", at);
        see(0, step.x, x, "step", at);
        see(0, step.y, y, "step", at);
        let acc = array::<3>(&tick["acc"]);
        // At the tick that ends double support the other program's pressure is still that of before.
        let is_after = before == "ds" && mode != "ds";
        let linear = match task.motion.linear {
            LinearTask::CenterOfMass(a) => [a.x, a.y, a.z],
            LinearTask::CenterOfPressure { point: [x, y], vertical, .. } => [x, y, vertical],
            LinearTask::Free => panic!("no flight in a walk"),
        };
        for (x, y) in linear.into_iter().zip(acc).skip(if is_after { 2 } else { 0 }) {
            see(1, x, y, "the whole", at);
        }
        let AngularTask::CentralBody(angular) = task.motion.angular else { panic!("no leap") };
        for (x, y) in angular.iter().zip(array::<3>(&tick["ang"])) {
            see(1, *x, y, "trunk", at);
        }
        let feet = tick["feet"].as_array().expect("feet").len();
        for (k, foot) in task.motion.feet.iter().take(feet).enumerate() {
            let theirs = &tick["swing"][k.to_string()];
            match foot {
                FootTask::Press { most_force } => {
                    assert!(theirs.is_null(), "foot {k} swings at tick {at}");
                    let cap = &tick["cap"][k.to_string()];
                    match cap.as_f64() {
                        Some(cap) if !is_after => see(1, *most_force, cap, "cap", at),
                        Some(_) => {}
                        None => assert_eq!(*most_force, f64::INFINITY),
                    }
                }
                FootTask::Swing { linear, angular } => {
                    let theirs = numbers(theirs);
                    // Of points nothing turns.
                    let count = if name(walk) == "pairs" { 3 } else { 6 };
                    let ours = linear.iter().chain(angular.iter()).take(count);
                    for (i, (x, y)) in ours.zip(theirs).enumerate() {
                        see(2, *x, y, ["foot x", "y", "z", "turn x", "turn y", "turn z"][i], at);
                    }
                }
            }
        }
        before = mode;
    }
    worst
}

#[test]
fn walks_are_planned_as_in_python_tick_by_tick() {
    // Numbers are written down with seven decimals. Measured: 1e-7 at most.
    for walk in walk()["walks"].as_array().expect("walks") {
        let worst = walked(walk);
        assert!(worst.iter().all(|x| *x < 1e-6), "{worst:?}");
    }
}

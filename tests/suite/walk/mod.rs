//! The planner of walks: its closed forms and its ticks against an independent program, what a periodic gait is by
//! definition, and what it refuses.

mod hostile;
mod leap;
mod periodic;
mod vectors;

use nalgebra::{Matrix3, Vector2, Vector3};
use serde_json::Value;
use surefoot::Real;
use surefoot::balance::{ObservedFoot, ObservedMotion};
use surefoot::walk::{Planner, Side, StandingRobot, Stature};
use surefoot_tests::vectors::{array, walk};

const FEET: usize = 4;

/// Numbers of a list.
fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("a list").iter().map(|x| x.as_f64().expect("a number")).collect()
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

fn vector<T: Real>([x, y, z]: [f64; 3]) -> Vector3<T> {
    Vector3::new(T::of(x), T::of(y), T::of(z))
}

fn about_z<T: Real>(angle: f64) -> Matrix3<T> {
    let (s, c) = angle.sin_cos();
    Matrix3::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0).map(T::of)
}

/// A foot that is level.
fn foot<T: Real>(
    position: [f64; 3],
    velocity: [f64; 6],
    yaw: f64,
    leg: [f64; 3],
) -> ObservedFoot<T> {
    let [x, y, z, p, q, r] = velocity;
    ObservedFoot {
        position: vector(position),
        rotation: about_z(yaw),
        velocity: vector([x, y, z]),
        angular_velocity: vector([p, q, r]),
        leg: vector(leg),
    }
}

fn nowhere<T: Real>() -> ObservedFoot<T> {
    foot([0.0; 3], [0.0; 6], 0.0, [0.0; 3])
}

/// One of the robots of the vectors as it stands.
fn standing<T: Real>(
    name: &str,
) -> (StandingRobot<T>, [Option<Side>; FEET], ObservedMotion<T, FEET>) {
    let all = walk();
    let robot = &all["robots"][name];
    let of = |key: &str| number(&robot[key]);
    let feet: Vec<[f64; 3]> = robot["feet"].as_array().expect("feet").iter().map(array).collect();
    let is_left = |k: usize| if feet.len() == 2 { k == 0 } else { k == 0 || k == 3 };
    let side = |k: usize| if is_left(k) { Side::Left } else { Side::Right };
    let sole = Vector2::new(T::of(of("X")), T::of(of("Y")));
    let described = StandingRobot {
        mass: T::of(of("mass")),
        gravity: T::of(9.81),
        leg_length: T::of(of("leg")),
        forward: T::zero(),
        sole,
        pressure_reach: sole,
    };
    let observed = ObservedMotion {
        center_of_mass: vector([0.0, 0.0, of("z")]),
        velocity: Vector3::zeros(),
        angular_momentum: Vector3::zeros(),
        central_rotation: Matrix3::identity(),
        angular_velocity: Vector3::zeros(),
        feet: std::array::from_fn(|k| match feet.get(k) {
            Some(at) => foot(*at, [0.0; 6], 0.0, [0.0, 0.0, -of("h0")]),
            None => nowhere(),
        }),
    };
    let sides = std::array::from_fn(|k| (k < feet.len()).then(|| side(k)));
    (described, sides, observed)
}

fn planner<T: Real>(name: &str) -> Planner<T, FEET> {
    let (robot, sides, observed) = standing(name);
    Planner::new(Stature::measured(&robot, &sides, &observed).expect("a robot that stands"))
}

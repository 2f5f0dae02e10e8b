//! `peers_loop SCENE`: what `cargo xtask peers --loop` needs to close a scene's loop on another plant: the robot as a
//! MuJoCo model with its start, the controller's settings, and what this project's plant survives. One JSON document.

use serde_json::{Value, json};
use surefoot_host::precision::mujoco_model;
use surefoot_sim::closed_loop::{self, Scalar, controller};
use surefoot_sim::plant::{Additions, Variational};
use surefoot_sim::scene::{Feet, Push, Scene, load};

/// Directions of pushes, degrees: 0 along x, 90 along y.
const DIRECTIONS: [f64; 5] = [0.0, 45.0, 90.0, 135.0, 180.0];
/// N·s
const STEP: f64 = 1.0;
const MOST: f64 = 60.0;
/// When a push begins, and how long it lasts, s.
const AT: f64 = 0.7;
const LASTS: f64 = 0.1;

fn main() {
    let name = std::env::args().nth(1).unwrap_or_else(|| "stand".to_owned());
    let scene = load(&name).expect("a scene of a robot");
    let Feet::Floor { floor, .. } = &scene.feet else { panic!("a robot on a floor") };
    let robot = scene.robot();
    let additions = Additions::default();
    let plant = Variational::on_floor(&robot, &scene.start(), 1e-3, *floor, &additions);
    let plant = plant.expect("a start");
    let (joints, (link, frame)) = (plant.hinges(), plant.central());
    let model = mujoco_model(&mut plant.simulation().clone()).expect("hinges and a free body");
    let settings = &scene.controller;
    let survived: Vec<Value> = DIRECTIONS
        .into_iter()
        .map(|degrees| json!({ "degrees": degrees, "impulse": largest(&scene, degrees) }))
        .collect();
    println!(
        "{}",
        json!({
            "xml": model.xml,
            "qpos": model.qpos,
            "joints": joints,
            "central": {
                "link": link,
                "position": frame.position.as_slice(),
                "orientation": frame.orientation.to_array(),
            },
            "friction": floor.dynamic_friction,
            "period": 1.0 / settings.rate_hz,
            "gains": [
                settings.position_gain,
                settings.velocity_gain,
                settings.orientation_gain,
                settings.angular_velocity_gain,
            ],
            "set_point": {
                "position": scene.set_point.position_m,
                "orientation": scene.set_point.orientation,
            },
            "duration": scene.duration_s,
            "push": { "at": AT, "lasts": LASTS, "step": STEP, "most": MOST },
            "ours": survived,
        })
    );
}

/// The largest impulse that is survived, with all below it, N·s.
fn largest(scene: &Scene, degrees: f64) -> f64 {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    let survives = |impulse: f64| {
        let mut scene = scene.clone();
        let force = impulse / LASTS;
        let force_n = [force * cosine, force * sine, 0.0];
        scene.pushes.push(Push { at_s: AT, duration_s: LASTS, force_n });
        let mut controller = controller(&scene, Scalar::F32);
        let run = closed_loop::run(&scene, controller.as_mut(), &mut |_| {});
        run.failure.is_none()
            && run.samples.last().is_some_and(|last| {
                last.error_distance() < 0.05 && last.error_angle() < 5_f64.to_radians()
            })
    };
    let mut impulse = 0.0;
    while impulse + STEP <= MOST && survives(impulse + STEP) {
        impulse += STEP;
    }
    impulse
}

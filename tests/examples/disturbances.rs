//! What a robot that knows neither its state nor what disturbs it makes of each disturbance: `disturbances [SECONDS]`. The
//! scene `stand-loaded` with one of them at a time, its centre of mass and tilt against where they should be, after 6 s
//! of standing (as far as the run goes) and at the end; with the true state beside it.

use surefoot_sim::closed_loop::{self, Scalar, bare_controller, controller, rest_error};
use surefoot_sim::scene::{Push, Scene, StateSource, load};

fn main() {
    let seconds = std::env::args().nth(1).and_then(|x| x.parse().ok()).unwrap_or(8.0);
    println!("{:<36}{:>28}{:>28}", "", "true state", "estimator");
    for (name, change) in CASES {
        print!("{name:<36}");
        for state in [StateSource::Truth, StateSource::Estimate] {
            let mut scene = load("stand-loaded").expect("built in");
            scene.plant = Default::default();
            scene.sensing.state = state;
            scene.duration_s = seconds;
            change(&mut scene);
            print!("{:>28}", outcome(&scene));
        }
        println!();
    }
}

type Change = fn(&mut Scene);

const CASES: [(&str, Change); 11] = [
    ("nothing else", |_| ()),
    ("+20 kg", |scene| body(scene, [0.0; 3], Some(20.0))),
    ("centre of mass 3 cm back", |scene| body(scene, [0.03, 0.0, 0.0], None)),
    ("centre of mass 3 cm ahead", |scene| body(scene, [-0.03, 0.0, 0.0], None)),
    ("slope of 5°, no supervisor", |scene| scene.terrain.slope_deg = 5.0),
    ("IMU roll 1.5°, no other bias", |scene| {
        askew(scene, 1.5);
        scene.sensing.gyroscope_bias = [0.0; 3];
        if scene.sensing.state == StateSource::Estimate {
            scene.sensing.accelerometer_bias = [0.0; 3];
        }
    }),
    ("IMU roll 1.5°", |scene| askew(scene, 1.5)),
    ("IMU roll 2°", |scene| askew(scene, 2.0)),
    ("encoders off by 0.5°, random signs", |scene| {
        for (k, name) in scene.robot().columns.iter().enumerate() {
            let sign = if [0, 2, 3, 7, 8, 10].contains(&k) { 1.0 } else { -1.0 };
            scene.sensing.encoder_bias_deg.insert(name.clone(), 0.5 * sign);
        }
    }),
    ("Coulomb friction of 2 N·m", friction),
    ("the same, 8 N·s at 45° at 1 s", |scene| {
        friction(scene);
        scene.pushes = vec![Push { at_s: 1.0, duration_s: 0.1, force_n: [56.6, 56.6, 0.0] }];
    }),
];

fn body(scene: &mut Scene, shift: [f64; 3], added: Option<f64>) {
    let name = scene.robot().bodies[0].clone();
    let table = scene.plant.bodies.entry(name).or_default();
    (table.center_shift_m, table.added_mass_kg) = (shift, added);
}

/// With the true state, one that is askew.
fn askew(scene: &mut Scene, roll: f64) {
    scene.sensing.imu_tilt_deg = [roll, 0.0, 0.0];
    if scene.sensing.state == StateSource::Truth {
        scene.sensing.state = StateSource::Noise;
        (scene.sensing.gyroscope_noise, scene.sensing.accelerometer_noise) = (0.0, 0.0);
        scene.sensing.encoder_counts = 0;
        (scene.sensing.gyroscope_bias, scene.sensing.accelerometer_bias) = ([0.0; 3], [0.0; 3]);
    }
}

fn friction(scene: &mut Scene) {
    scene.plant.every_joint.get_or_insert_default().friction_nm = Some(2.0);
}

/// Millimetres and degrees, after 6 s and at the end.
fn outcome(scene: &Scene) -> String {
    // A landing on a slope is more than the supervisor believes of rates that are estimated.
    let mut controller = match scene.terrain.is_level() {
        true => controller(scene, Scalar::F32),
        false => bare_controller(scene, Scalar::F32),
    };
    let run = closed_loop::run(scene, controller.as_mut(), &mut |_| {});
    if let Some(failure) = &run.failure {
        return format!("{} at {:.1} s", failure.kind, failure.time_s);
    }
    let at = |time: f64| {
        let sample = run.samples.iter().find(|sample| sample.time_s >= time - 1e-9)?;
        let rest = rest_error(scene, sample)?;
        let [x, y] = rest.center_of_mass;
        Some(format!("{:.1} mm {:.2}°", 1e3 * x.hypot(y), rest.tilt.to_degrees()))
    };
    let end = run.samples.last().map_or(0.0, |last| last.time_s);
    [at(end.min(6.0)), at(end)].map(Option::unwrap_or_default).join(", ")
}

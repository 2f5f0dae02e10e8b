//! The biped that stands within limits, pushed.

use surefoot_sim::closed_loop::{self, Run, Scalar, bare_controller, controller};
use surefoot_sim::scene::{Push, Scene, load};

fn pushed(impulse: f64, degrees: f64, is_supervised: bool) -> (Scene, Run) {
    let mut scene = load("stand").expect("built in");
    let gain = |name: &str, default: f64| {
        std::env::var(name).ok().and_then(|x| x.parse().ok()).unwrap_or(default)
    };
    let c = &mut scene.controller;
    c.orientation_gain = [gain("KR", 50.0); 3];
    c.angular_velocity_gain = [gain("DR", 7.07); 3];
    let (kp, dp) = (gain("KP", 50.0), gain("DP", 7.07));
    c.position_gain = [kp, kp, gain("KZ", 200.0)];
    c.velocity_gain = [dp, dp, gain("DZ", 14.142)];
    let (sine, cosine) = degrees.to_radians().sin_cos();
    let force = impulse / 0.1;
    scene.duration_s = gain("T", 3.0);
    scene.pushes =
        vec![Push { at_s: 0.7, duration_s: 0.1, force_n: [force * cosine, force * sine, 0.0] }];
    let scalar = Scalar::F64;
    let mut controller = if is_supervised {
        controller(&scene, scalar)
    } else {
        bare_controller(&scene, scalar)
    };
    let run = closed_loop::run(&scene, controller.as_mut(), &mut |_| {});
    (scene, run)
}

fn survives(run: &Run) -> bool {
    let Some(last) = run.samples.last() else { return false };
    run.failure.is_none() && last.error_distance() < 0.05 && last.error_angle() < 5_f64.to_radians()
}

#[test]
#[ignore = "measures"]
fn tune() {
    let mut line = String::new();
    for degrees in [0.0, 45.0, 90.0, 135.0, 180.0] {
        for is_supervised in [false, true] {
            let (mut low, mut high) = (0.0, 60.0);
            let mut why = String::new();
            while high - low > 0.5 {
                let middle = 0.5 * (low + high);
                let (_, run) = pushed(middle, degrees, is_supervised);
                if survives(&run) {
                    low = middle;
                } else {
                    high = middle;
                    why = run.failure.map_or_else(|| "not there".into(), |f| format!("{:.2} {}", f.time_s, f.place));
                }
            }
            line += &format!("{degrees} {is_supervised}: {low:.1} ({why})\n");
        }
    }
    println!("{line}");
}

#[test]
#[ignore = "measures"]
fn look() {
    let get = |name: &str, default: f64| {
        std::env::var(name).ok().and_then(|x| x.parse().ok()).unwrap_or(default)
    };
    let (_, run) = pushed(get("J", 10.0), get("DEG", 0.0), get("SUP", 0.0) > 0.0);
    for (i, s) in run.samples.iter().enumerate() {
        if i % 25 == 0 || (i > 340 && i % 5 == 0 && i < 600) {
            println!(
                "{:.3} e {:6.3} {:6.3} {:6.3} | {:5.1}° | w {:5.0?} | F {:5.0?} | t {:4.0?}",
                s.time_s, s.position_error[0], s.position_error[1], s.position_error[2],
                s.error_angle().to_degrees(), s.desired_wrench, s.foot_forces, s.torques
            );
        }
    }
    println!("{:?} {:?} {:?}", run.outcome, run.failure, run.limits);
}

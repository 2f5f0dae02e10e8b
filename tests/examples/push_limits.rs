//! Largest pushes of 0.1 s that the scene `stand` survives, by direction: `push_limits [STEP [SCENE
//! [bare]]]`. Impulses rise by STEP (N·s) from it until one is not survived: stopped by the supervisor
//! (unless `bare`), fallen, or at the end 5 cm or 5° from the set point.

use surefoot_sim::closed_loop::{self, Scalar, bare_controller, controller};
use surefoot_sim::scene::{Push, load};

fn main() {
    let mut arguments = std::env::args().skip(1);
    let step = arguments.next().and_then(|x| x.parse().ok()).unwrap_or(1.0);
    let name = arguments.next().unwrap_or_else(|| "stand".to_owned());
    let is_bare = arguments.next().is_some_and(|word| word == "bare");
    for degrees in [0.0, 45.0, 90.0, 135.0, 180.0] {
        let (sine, cosine) = f64::to_radians(degrees).sin_cos();
        let mut survived = 0.0;
        loop {
            let mut scene = load(&name).expect("a scene of a robot");
            let force = (survived + step) / 0.1;
            let force_n = [force * cosine, force * sine, 0.0];
            scene.pushes = vec![Push { at_s: 0.7, duration_s: 0.1, force_n }];
            let mut controller = if is_bare {
                bare_controller(&scene, Scalar::F64)
            } else {
                controller(&scene, Scalar::F64)
            };
            let run = closed_loop::run(&scene, controller.as_mut(), &mut |_| {});
            let arrived = run.samples.last().is_some_and(|last| {
                last.error_distance() < 0.05 && last.error_angle() < 5_f64.to_radians()
            });
            if run.failure.is_some() || !arrived || survived > 100.0 {
                let why = run.failure.map_or("not at the set point".to_owned(), |failure| {
                    format!("{} at {:.2} s", failure.place, failure.time_s)
                });
                println!("{degrees:>4}°: {survived:.1} N·s; then {why}");
                break;
            }
            survived += step;
        }
    }
}

//! A push gives its impulse, however it lies to steps and ticks.

use surefoot_sim::scene::{AnyScene, Push, Scene, open};

fn scene_with(pushes: Vec<Push>) -> Scene {
    let AnyScene::Robot(mut scene) = open("experiment-1").expect("built in") else {
        unreachable!("a robot")
    };
    scene.pushes = pushes;
    *scene
}

/// Over steps that begin and end anywhere, the mean forces add up to force times duration.
#[test]
fn impulses_are_exact() {
    for (at_s, duration_s, h) in [
        (0.0101, 0.0003, 2e-3),
        (0.0101, 0.0003, 1e-4),
        (0.0, 0.05, 2e-3),
        (0.0299, 0.0202, 2e-3),
        (0.007, 1e-6, 2e-3),
    ] {
        let scene = scene_with(vec![
            Push { at_s, duration_s, force_n: [100.0, -50.0, 25.0] },
            Push { at_s: 0.02, duration_s: 0.013, force_n: [0.0, 0.0, -10.0] },
        ]);
        let steps = (0.1_f64 / h).round() as u32;
        let impulse = (0..steps)
            .filter_map(|k| scene.push(f64::from(k) * h, f64::from(k + 1) * h))
            .map(|wrench| wrench.force * h)
            .sum::<nalgebra::Vector3<f64>>();
        let right =
            nalgebra::Vector3::new(100.0, -50.0, 25.0) * duration_s - nalgebra::Vector3::z() * 0.13;
        // Round-off of the times, measured 2e-15 of 5.
        assert!((impulse - right).norm() < 1e-14, "{at_s} {duration_s} {h}: {impulse:?}");
        // None costs nothing.
        assert!(scene.push(0.09, 0.092).is_none());
    }
}

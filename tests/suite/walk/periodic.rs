//! What a periodic gait is by definition: its offsets come back, under the pendulum's own motion.

use super::planner;
use nalgebra::Vector2;
use surefoot::walk::{Gait, Side, StepQuery, next_step, periodic_step};

/// The capture point after `time`, by the closed form of `ξ' = ω (ξ − p)` with a centre of pressure that starts at `p`
/// and moves at `rate`.
fn led(
    omega: f64,
    xi: Vector2<f64>,
    p: Vector2<f64>,
    rate: Vector2<f64>,
    time: f64,
) -> Vector2<f64> {
    let ahead = rate / omega;
    p + rate * time + ahead + (xi - p - ahead) * (omega * time).exp()
}

#[test]
fn the_gait_repeats_itself_under_the_pendulum() {
    for name in ["soles", "pairs"] {
        let gait: Gait<f64> = planner(name).gait;
        for velocity in [[0.0, 0.0], [0.7, 0.0], [-0.3, 0.1], [0.5, -0.2]].map(Vector2::from) {
            let mut side = Side::Left;
            let mut stance = Vector2::zeros();
            let mut xi = stance + periodic_step(&gait, side.other(), velocity).at_lift_off;
            for _ in 0..6 {
                let step = periodic_step(&gait, side, velocity);
                xi = led(gait.omega, xi, stance, Vector2::zeros(), gait.single);
                // a, from the old point.
                assert!((xi - stance - step.at_touch_down).norm() < 1e-13);
                let rate = step.step / gait.double;
                xi = led(gait.omega, xi, stance, rate, gait.double);
                stance += step.step;
                // b, from the new one.
                assert!((xi - stance - step.at_lift_off).norm() < 1e-13, "{name} {velocity:?}");
                // Rounding grows with it.
                xi = stance + step.at_lift_off;
                side = side.other();
            }
            // Two steps on there is a stride, at the wanted speed.
            let stride = periodic_step(&gait, side, velocity).step
                + periodic_step(&gait, side.other(), velocity).step;
            let time = 2.0 * (gait.single + gait.double);
            assert!((stride - velocity * time).norm() < 1e-14);
        }
    }
}

#[test]
fn on_the_periodic_gait_the_step_is_the_periodic_one() {
    let gait: Gait<f64> = planner("soles").gait;
    let velocity = Vector2::new(0.6, -0.1);
    for side in [Side::Left, Side::Right] {
        let periodic = periodic_step(&gait, side, velocity);
        for share in [0.0, 0.3, 0.8] {
            let elapsed = share * gait.single;
            let left = gait.single - elapsed;
            let offset = periodic.at_touch_down * (-gait.omega * left).exp();
            // Half-way, where it can still get anywhere.
            let swinging = periodic.step * share;
            let query = StepQuery { side, offset, velocity, elapsed, swinging };
            let step = next_step(&gait, &query);
            assert!((step.left - left).abs() < 1e-15);
            assert!((step.step - periodic.step).norm() < 1e-14);
            assert!(step.miss.norm() < 1e-14);
        }
    }
}

#[test]
fn steps_stay_in_reach_and_on_their_own_side() {
    let gait: Gait<f64> = planner("soles").gait;
    for k in 0..200 {
        let angle = f64::from(k) * 0.7;
        let offset = Vector2::new(angle.cos(), angle.sin()) * (0.01 * f64::from(k));
        let side = if k % 2 == 0 { Side::Left } else { Side::Right };
        let outside = -side.sign::<f64>();
        let swinging = Vector2::new(0.2, outside * gait.width);
        let query = StepQuery {
            side,
            offset,
            velocity: Vector2::zeros(),
            elapsed: 0.002 * f64::from(k),
            swinging,
        };
        let step = next_step(&gait, &query);
        let [least, _] = gait.outwards;
        assert!(outside * step.step.y >= least - 1e-15);
        assert!((step.step - swinging).norm() <= gait.foot_speed * step.left.max(0.3) + 1e-12);
        assert!(step.left > 0.0 && step.left <= gait.times[1]);
    }
}

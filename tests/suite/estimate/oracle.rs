//! Against an independent filter on the same log: `vectors/estimate_vectors.py`, which keeps a dense covariance and takes
//! one row after the other.

use super::motion::{PERIOD, TICKS, readings, soles, started, truth};
use nalgebra::Vector3;
use surefoot::estimate::{Estimator, Floor, FootKind, Readings, Turn};
use surefoot::spatial::Quaternion;
use surefoot_tests::vectors::{array, estimates};

/// Largest differences of position, quaternion, body velocity, angular velocity, biases, and relative ones of
/// standard deviations, over 10 s.
fn differences(
    settings: &Estimator<f64, 2>,
    name: &str,
    feed: impl Fn(u32, &mut Readings<f64, 2>),
) -> [f64; 6] {
    let file = estimates();
    let rows: Vec<[f64; 35]> =
        file[name].as_array().expect("a case").iter().map(array::<35>).collect();
    let mut rows = rows.iter().peekable();
    let mut state = started(settings);
    let mut worst = [0.0_f64; 6];
    for tick in 0..TICKS {
        let mut now = readings(tick);
        feed(tick, &mut now);
        let report = settings.step(&mut state, &now).expect("good readings");
        let Some(row) = rows.next_if(|row| row[0] == f64::from(tick + 1)) else { continue };
        let estimate = report.estimate;
        let q = estimate.orientation;
        let q = if q.s < 0.0 { q.to_array().map(|x| -x) } else { q.to_array() };
        let deviations = state.deviations();
        let ours = [
            estimate.position.as_slice(),
            &q,
            estimate.velocity.linear.as_slice(),
            estimate.velocity.angular.as_slice(),
            state.accelerometer_bias.as_slice(),
            state.gyroscope_bias.as_slice(),
        ]
        .concat();
        let off = |range: std::ops::Range<usize>| {
            let pairs = ours[range.clone()].iter().zip(&row[1 + range.start..1 + range.end]);
            pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        };
        let relative = deviations.iter().flatten().zip(&row[20..]);
        let relative = relative.map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max);
        let found = [off(0..3), off(3..7), off(7..10), off(10..13), off(13..19), relative];
        for (worst, found) in worst.iter_mut().zip(found) {
            *worst = worst.max(if found.is_nan() { f64::INFINITY } else { found });
        }
    }
    assert!(rows.next().is_none(), "{name}: not all of the log");
    println!("{name}: {worst:?}");
    worst
}

#[test]
fn agrees_with_an_independent_filter_over_ten_seconds() {
    let none = |_: u32, _: &mut Readings<f64, 2>| {};
    let all = Estimator { turn: Turn::All, ..soles() };
    let points = Estimator { feet: [Some(FootKind::Point); 2], ..all };
    let level = Estimator { floor: Floor::LevelAt(0.0), ..all };
    for (name, found) in [
        ("soles", differences(&all, "soles", none)),
        ("points", differences(&points, "points", none)),
        ("in turn", differences(&soles(), "in_turn", none)),
        ("level", differences(&level, "level", none)),
        (
            "forces",
            differences(&all, "forces", |tick, now| {
                let q = truth(f64::from(tick) * PERIOD).orientation;
                let force = q.conjugate().rotate(Vector3::new(2e-3, -1e-3, 1.0)) * 700.0;
                now.feet_force = (tick < 500).then_some(force);
            }),
        ),
    ] {
        assert!(found.iter().all(|x| *x < 1e-8), "{name}: {found:?}");
    }
}

/// The equation that the oracle has otherwise (see there) is worth micrometres.
#[test]
fn what_the_oracle_has_otherwise_is_small() {
    let otherwise = estimates()["unmodified"].as_f64().expect("a number");
    assert!((1e-7..1e-5).contains(&otherwise), "{otherwise}");
}

/// A sensor that is turned, and away from the centre of mass, gives the same estimate as one that is not.
#[test]
fn a_mounted_sensor_gives_the_same_estimate() {
    let turn = Quaternion::from_rotation_vector(Vector3::new(0.3, -0.5, 1.2));
    let mut mounted = soles::<f64>();
    mounted.imu.rotation = turn.to_matrix();
    mounted.imu.position = Vector3::new(0.1, -0.05, 0.2);
    let arm = mounted.imu.position;
    let plain = soles::<f64>();
    let (mut a, mut b) = (None, started(&plain));
    let mut worst = [0.0_f64; 3];
    for tick in 0..2000 {
        let t = f64::from(tick) * PERIOD;
        let without = readings(tick);
        let mut now = without;
        // What the point at the arm feels beside the centre of mass.
        let velocity = |t: f64| {
            let [before, after] = [t - 1e-6, t + 1e-6].map(|t| truth(t).orientation.rotate(arm));
            truth(t).velocity + (after - before) / 2e-6
        };
        if tick > 0 {
            let here = (velocity(t) - velocity(t - PERIOD)) / PERIOD;
            let [now_v, before_v] = [t, t - PERIOD].map(|t| truth(t).velocity);
            let extra = here - (now_v - before_v) / PERIOD;
            let middle = truth(t - 0.5 * PERIOD).orientation.conjugate();
            now.imu.accelerometer += middle.rotate(extra);
        }
        let back = turn.conjugate();
        now.imu.accelerometer = back.rotate(now.imu.accelerometer);
        now.imu.gyroscope = back.rotate(now.imu.gyroscope);
        let state = a.get_or_insert_with(|| {
            let pose = surefoot::estimate::StartPose::origin();
            surefoot::estimate::EstimatorState::start(&mounted, &now, &pose).expect("at rest")
        });
        let ours = mounted.step(state, &now).expect("good readings").estimate;
        let theirs = plain.step(&mut b, &without).expect("good readings").estimate;
        let turned = (ours.orientation.v - theirs.orientation.v).norm();
        let found = [
            (ours.position - theirs.position).norm(),
            turned,
            (ours.velocity.linear - theirs.velocity.linear).norm(),
        ];
        for (worst, found) in worst.iter_mut().zip(found) {
            *worst = worst.max(found);
        }
    }
    println!("mounted: {worst:?}");
    // Errors of the two are correlated otherwise: the same filter in other coordinates, to its own errors.
    assert!(worst[0] < 1e-3 && worst[1] < 1e-3 && worst[2] < 5e-3, "{worst:?}");
}

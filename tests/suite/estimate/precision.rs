//! Single precision against double, and feet in turn against all at once, on the same log.

use super::motion::{TICKS, readings, rounded, soles, started};
use nalgebra::Vector3;
use surefoot::Real;
use surefoot::estimate::{Estimate, Estimator, Turn};

/// Position, velocity and vector part of the quaternion.
fn numbers<T: Real>(estimate: &Estimate<T>) -> [Vector3<f64>; 3] {
    let Estimate { position, orientation, velocity } = estimate;
    let q = if orientation.s < T::zero() { -orientation.v } else { orientation.v };
    [position, &velocity.linear, &q].map(|v| v.map(Real::to_f64))
}

/// Largest differences of these between two filters.
fn apart<A: Real, B: Real>(a: &Estimator<A, 2>, b: &Estimator<B, 2>) -> [f64; 3] {
    let (mut x, mut y) = (started(a), started(b));
    let mut worst = [0.0_f64; 3];
    for tick in 0..TICKS {
        let now = readings(tick);
        let ours = a.step(&mut x, &rounded(&now)).expect("good readings").estimate;
        let theirs = b.step(&mut y, &rounded(&now)).expect("good readings").estimate;
        for (worst, (a, b)) in worst.iter_mut().zip(numbers(&ours).iter().zip(numbers(&theirs))) {
            *worst = worst.max((a - b).norm());
        }
    }
    println!("{worst:?}");
    worst
}

/// The reference has 4.4 µm, 0.023 mm/s and 1.4e-6 on its log.
#[test]
fn single_precision_is_micrometres_away() {
    let [position, velocity, turn] = apart::<f32, f64>(&soles(), &soles());
    assert!(position < 20e-6, "{position} m");
    assert!(velocity < 0.1e-3, "{velocity} m/s");
    assert!(turn < 5e-6, "{turn}");
}

/// The reference has 0.3 mm and 1.1 mm/s on its log; here they are 0.56 mm and 3.1 mm/s.
#[test]
fn feet_in_turn_are_a_millimetre_from_all_at_once() {
    let all = Estimator { turn: Turn::All, ..soles() };
    let [position, velocity, turn] = apart::<f64, f64>(&soles(), &all);
    assert!(position < 1e-3 && velocity < 4e-3 && turn < 1e-3, "{position} {velocity} {turn}");
}

//! The covariance stays one: symmetric, and positive.

use super::motion::{TICKS, readings, rounded, soles, started};
use nalgebra::DMatrix;
use surefoot::Real;
use surefoot::estimate::{Estimator, EstimatorState, FootKind};

/// All errors that there are.
fn covariance<T: Real, const FEET: usize>(
    settings: &Estimator<T, FEET>,
    state: &EstimatorState<T, FEET>,
) -> DMatrix<f64> {
    let entry = |row, column| state.covariance_entry(settings, row, column);
    let size = (0..).take_while(|row| entry(*row, 0).is_some()).count();
    DMatrix::from_fn(size, size, |i, j| entry(i, j).expect("an error that there is").to_f64())
}

/// The least eigenvalue over the log and how many errors there were at most; exactly symmetric at all times.
fn least<T: Real>(settings: &Estimator<T, 2>) -> (f64, usize) {
    let mut state = started(settings);
    let (mut least, mut size) = (f64::INFINITY, 0);
    for tick in 0..TICKS {
        let report = settings.step(&mut state, &rounded(&readings(tick))).expect("good readings");
        assert!(report.health.is_good(), "{:?}", report.health);
        if tick % 50 != 0 {
            continue;
        }
        let p = covariance(settings, &state);
        assert_eq!(p, p.transpose());
        // By standard deviations, which differ by a thousand.
        let scale = p.diagonal().map(|x| 1.0 / x.sqrt());
        let correlation =
            DMatrix::from_fn(p.nrows(), p.nrows(), |i, j| p[(i, j)] * scale[i] * scale[j]);
        least = least.min(correlation.symmetric_eigenvalues().min());
        size = size.max(p.nrows());
    }
    (least, size)
}

#[test]
fn the_covariance_is_symmetric_and_positive_in_both_precisions() {
    let (double, size) = least::<f64>(&soles());
    let (single, _) = least::<f32>(&soles());
    println!("{double:e} {single:e}");
    assert_eq!(size, 27);
    assert!(double > 1e-6, "{double}");
    assert!((single / double - 1.0).abs() < 0.05, "{single} and {double}");
    let points = Estimator { feet: [Some(FootKind::Point); 2], ..soles::<f64>() };
    let (least, size) = least(&points);
    assert!(size == 21 && least > 1e-6, "{size} {least}");
}

/// An absent foot is as if it were not there, whatever its readings are.
#[test]
fn an_absent_foot_changes_nothing() {
    let two = soles::<f64>();
    let sole = Some(FootKind::Sole);
    let four = Estimator::new(two.period_s, two.gravity, [sole, None, sole, None]);
    let wide = |tick| {
        let now = readings(tick);
        let nothing = surefoot::estimate::FootReading {
            position: nalgebra::Vector3::repeat(f64::NAN),
            orientation: surefoot::spatial::Quaternion::from_array([0.0; 4]),
            is_pressed: true,
            is_planned: true,
        };
        let [a, b] = now.feet;
        surefoot::estimate::Readings {
            imu: now.imu,
            feet: [a, nothing, b, nothing],
            feet_force: None,
        }
    };
    let mut narrow = started(&two);
    let origin = surefoot::estimate::StartPose::origin();
    let mut state = EstimatorState::start(&four, &wide(0), &origin).expect("at rest");
    for tick in 0..2000 {
        let a = two.step(&mut narrow, &readings(tick)).expect("good readings");
        let b = four.step(&mut state, &wide(tick)).expect("good readings");
        assert_eq!(a.estimate, b.estimate, "tick {tick}");
    }
}

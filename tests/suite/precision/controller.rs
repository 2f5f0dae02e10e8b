//! What precision and rate do to the controller.

use surefoot_sim::closed_loop::Scalar;
use surefoot_sim::precision::{ControllerPrecision, controller_precision};

fn torque(precision: &ControllerPrecision, factor: Option<f64>, scalar: Scalar) -> f64 {
    let is_it =
        |row: &&surefoot_sim::precision::TorqueError| row.factor == factor && row.scalar == scalar;
    let row = precision.torques.iter().find(is_it).expect("a row");
    row.largest.unwrap_or(f64::INFINITY)
}

/// A big base is off by one over its mass where numbers are long enough, and by round-off times its mass where
/// they are not; the exact foot by neither. Slower controllers stray further.
#[test]
fn a_big_base_wants_more_digits_than_single_precision_has() {
    let precision = controller_precision().expect("a built-in scene");
    let base = |power: i32, scalar| torque(&precision, Some(10_f64.powi(power)), scalar);
    for power in [2, 3, 4] {
        let (light, heavy) = (base(power, Scalar::F64), base(power + 1, Scalar::F64));
        println!("f64, 1e{power}: {light:.1e}; ten times as heavy: {heavy:.1e}");
        assert!((8.0..12.5).contains(&(light / heavy)), "{light:.2e} {heavy:.2e}");
    }
    let exact = torque(&precision, None, Scalar::F32);
    let best = (2..=9).map(|power| base(power, Scalar::F32)).fold(f64::INFINITY, f64::min);
    println!("f32: exact foot {exact:.1e}, best big base {best:.1e}");
    assert!(exact < 1e-5, "{exact:.1e}");
    assert!(best > 10.0 * exact, "{best:.1e}");
    assert!(base(6, Scalar::F32) > 100.0 * base(6, Scalar::F64));
    let position = |rate: f64| {
        let row = precision.tracking.iter().find(|row| row.rate_hz == rate).expect("a rate");
        row.position_m.expect("it stands")
    };
    let (fast, printed, slow) = (position(2000.0), position(500.0), position(125.0));
    println!("strays by {fast:.1e}, {printed:.1e}, {slow:.1e} m at 2000, 500, 125 Hz");
    assert!(fast < printed && printed < slow);
}

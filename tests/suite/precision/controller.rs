//! What precision, rate, and things left out do to the controller.

use surefoot_host::precision::{ControllerForm, ControllerPrecision, controller_precision};
use surefoot_sim::closed_loop::{Approximation, Scalar, approximate_controller, bare_controller};
use surefoot_sim::plant::PlantState;
use surefoot_sim::scene::load;

fn of_form(precision: &ControllerPrecision, form: ControllerForm) -> f64 {
    let row = precision.torques.iter().find(|row| row.form == form).expect("a row");
    row.largest.unwrap_or(f64::INFINITY)
}

fn torque(precision: &ControllerPrecision, factor: Option<f64>, scalar: Scalar) -> f64 {
    of_form(precision, ControllerForm { scalar, factor, approximation: None })
}

/// A big base is off by one over its mass where numbers are long enough, and by round-off times its mass where
/// they are not; the exact foot by neither. Slower controllers stray further.
#[test]
fn a_big_base_wants_more_digits_than_single_precision_has() {
    let precision = controller_precision(false).expect("a built-in scene");
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
    // At touch-down, where velocities jump, all dynamics of before are as wrong; else older ones are worse.
    let less = |approximation, scalar| {
        let form = ControllerForm { scalar, factor: None, approximation: Some(approximation) };
        let row = precision.torques.iter().find(|row| row.form == form).expect("a row");
        (row.largest.expect("no faults"), row.median.expect("no faults"))
    };
    let held = [Approximation::HeldFor2, Approximation::HeldFor4, Approximation::HeldFor8];
    for scalar in [Scalar::F64, Scalar::F32] {
        let [two, four, eight] = held.map(|held| less(held, scalar));
        let slow = less(Approximation::NoVelocityProducts, scalar);
        println!(
            "held for 2, 4, 8 ticks: {two:?}, {four:?}, {eight:?}; no velocity products: {slow:?}"
        );
        assert!(two.1 < four.1 && four.1 < eight.1);
        // In single precision what is left out outweighs round-off all the same.
        for (largest, _) in [two, four, eight, slow] {
            assert!((1e3 * exact..1.0).contains(&largest), "{largest:.1e}");
        }
    }
    assert_eq!(precision.uncounted.as_deref(), Some("not asked for"));
}

/// What is left out is nothing where there is nothing of it: by other formulas, the same torques.
#[test]
fn approximations_are_exact_where_nothing_is_left_out() {
    let scene = load("experiment-1").expect("built in");
    let at_rest = scene.initial.state();
    let mut moving = at_rest.clone();
    for (i, v) in moving.velocities.iter_mut().enumerate() {
        *v = 0.3 * (i as f64).sin();
    }
    for x in &mut moving.positions[7..] {
        *x += 0.05;
    }
    let mut exact = bare_controller(&scene, Scalar::F64);
    let mut apart = |other: &[f64], state: &PlantState| {
        let torques = exact.tick(state).expect("a regular state").torques;
        torques.iter().zip(other).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()))
    };
    let mut slow = approximate_controller(&scene, Scalar::F64, Approximation::NoVelocityProducts);
    let at = |state: &PlantState, of: &mut dyn surefoot_sim::closed_loop::Controller| {
        of.tick(state).expect("a regular state").torques
    };
    assert!(apart(&at(&at_rest, slow.as_mut()), &at_rest) < 1e-9);
    assert!(apart(&at(&moving, slow.as_mut()), &moving) > 1e-3);
    let mut held = approximate_controller(&scene, Scalar::F64, Approximation::HeldFor4);
    for tick in 0..9 {
        // Computed at ticks 0, 4 and 8, of two different states.
        let state = if tick == 0 || tick > 4 { at_rest.clone() } else { moving.clone() };
        let off = apart(&at(&state, held.as_mut()), &state);
        println!("tick {tick}: {off:.1e}");
        match tick {
            0 | 4 | 8 => assert!(off < 1e-8, "tick {tick}: {off:.1e}"),
            _ => assert!(off > 1e-3, "tick {tick}: {off:.1e}"),
        }
    }
}

//! Slopes of error against step, against known orders.

use super::UNTIMED;
use surefoot_host::precision::{AT_MIDPOINTS, Curve, problem, reference, sweep};

fn curves(name: &str) -> Vec<Curve> {
    let problem = problem(name).expect("a problem");
    let exact = reference(&problem, UNTIMED.most_evaluations).expect("a reference");
    println!("{name}: {} and {} are {:.1e} apart", exact.by, exact.checked_by, exact.apart);
    assert!(exact.apart < 1e-8, "{name}: {:.1e}", exact.apart);
    problem.contenders.iter().map(|c| sweep(&problem, c, &exact, &UNTIMED)).collect()
}

/// All show their order; those that `bend` are not yet straight where errors are clean, and come within half
/// an order, if they have clean errors at all.
fn assert_orders(name: &str, bend: &[&str]) {
    for curve in curves(name) {
        let Some(order) = curve.order.map(f64::from) else { continue };
        let found = curve.fit.map(|fit| fit.order);
        println!("  {}: {found:.2?}, known {order}", curve.method);
        if bend.contains(&curve.method.as_str()) {
            assert!(found.is_none_or(|found| (found - order).abs() < 0.5), "{name}: {found:?}");
            continue;
        }
        let found = found.unwrap_or_else(|| panic!("{name}: {} has no slope", curve.method));
        // Where steps are not yet short, terms of higher order add to a slope.
        let within = if order > 4.0 { 0.35 } else { 0.12 };
        assert!((found - order).abs() < within, "{name}: {}: {found}", curve.method);
    }
}

/// The endpoint rule's error has a term of second order that is large beside the first, projection one of
/// lower order than the method's own; constraints that drift leave Euler's method no error small enough to
/// fit.
#[test]
fn a_turning_body() {
    assert_orders(
        "rigid-body",
        &["variational-endpoint", "semi-implicit-euler", "runge-kutta-4-projected"],
    );
}

#[test]
fn a_double_pendulum() {
    assert_orders("double-pendulum", &["semi-implicit-euler"]);
}

#[test]
fn a_chain_of_ten() {
    assert_orders("chain", &[]);
}

#[test]
fn a_floating_tree() {
    assert_orders("biped-flight", &[]);
}

/// Points that enter the floor at midpoints cost an order; within the step they do not.
#[test]
fn contact_costs_an_order_at_midpoints() {
    for curve in curves("touch-down") {
        let found = curve.fit.expect("a slope").order;
        println!("  {}: {found:.2}", curve.method);
        let known = if curve.method == AT_MIDPOINTS { 1.0 } else { 2.0 };
        assert!((found - known).abs() < 0.12, "{}: {found}", curve.method);
    }
}

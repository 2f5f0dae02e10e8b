//! The simulator in joint coordinates makes the motion of the one with constraints, to round-off.

use super::trees::{floating_chain, mixed_tree};
use surefoot_multibody::{BodyState, ChainJoint, ConstrainedSimulation, Simulation, System};

/// Largest difference of any coordinate; quaternions up to their sign.
pub fn apart(a: &[BodyState], b: &[BodyState]) -> f64 {
    let mut largest = 0.0_f64;
    for (a, b) in a.iter().zip(b) {
        let along: f64 = (3..7).map(|i| a[i] * b[i]).sum();
        for i in 0..7 {
            let sign = if i < 3 { 1.0 } else { 1.0_f64.copysign(along) };
            largest = largest.max((a[i] - sign * b[i]).abs());
        }
    }
    largest
}

fn compare(name: &str, (system, states, rates): (System, Vec<BodyState>, Vec<BodyState>), h: f64) {
    let mut ours = Simulation::new(system.clone(), h, &states, &rates).expect("a start");
    let mut oracle = ConstrainedSimulation::new(system, h, states, rates).expect("a start");
    let mut largest = 0.0_f64;
    for step in 0..300 {
        ours.step().unwrap_or_else(|error| panic!("{name}: {error}"));
        oracle.step().unwrap_or_else(|error| panic!("{name}, oracle: {error}"));
        largest = largest.max(apart(&ours.states(), oracle.states()));
        assert!(largest < 1e-9, "{name}, step {step}: {largest:.1e}");
    }
    let rates = ours.rates().expect("rates");
    let of_rates = apart(&rates, &oracle.rates().expect("rates"));
    println!(
        "{name}: {largest:.1e} in coordinates, {of_rates:.1e} in rates, {:.2} iterations",
        ours.progress().mean_iterations()
    );
    assert!(of_rates < 1e-8, "{name}: {of_rates}");
}

#[test]
fn joint_coordinates_make_the_same_motion() {
    compare("revolute", floating_chain(6, ChainJoint::Alternating), 5e-3);
    compare("spherical", floating_chain(10, ChainJoint::Spherical), 5e-3);
    compare("mixed", mixed_tree(20), 5e-3);
    let chain = super::motion::CHAIN;
    let still = vec![[0.0; 7]; chain.links];
    compare("hanging", (chain.system().expect("a system"), chain.bent(0.3), still), 2e-3);
}

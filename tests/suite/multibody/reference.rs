//! Convergence to a reference that shares nothing with the simulator: `core`'s forward dynamics in joint
//! coordinates, under an adaptive method of eighth order.

use differential_equations::prelude::{ExplicitRungeKutta, IVP};
use surefoot::dynamics::{body_poses, forward_dynamics, joint_poses};
use surefoot::model::{Link, Tree};
use surefoot_multibody::{Chain, ChainJoint, Simulation};

const LINKS: usize = 6;
const CHAIN: Chain = Chain {
    links: LINKS,
    mass: 1.2,
    length: 0.4,
    radius: 0.06,
    joint: ChainJoint::Alternating,
    floats: false,
    gravity: 9.81,
};
const BEND: f64 = 0.35;
const SECONDS: f64 = 1.0;

/// The chain as a robot: hanging straight down at home.
static ROBOT: Tree<f64, LINKS, LINKS, LINKS> = Tree::new(links());

const fn links() -> [Link; LINKS] {
    let (m, l, r) = (CHAIN.mass, CHAIN.length, CHAIN.radius);
    let across = m * (3.0 * r * r + l * l) / 12.0;
    let mut all = [Link::fixed(0); LINKS];
    let mut k = 0;
    while k < LINKS {
        let axis = if k.is_multiple_of(2) { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
        let top = -(k as f64) * l;
        all[k] = Link::revolute(k, axis, [0.0, 0.0, top]).body(
            m,
            [across, across, 0.5 * m * r * r],
            [0.0, 0.0, top - 0.5 * l],
        );
        k += 1;
    }
    all
}

/// Centres of mass.
fn reference() -> Vec<[f64; 3]> {
    let rates = |_: f64, y: &Vec<f64>, rates: &mut Vec<f64>| {
        let angles: [f64; LINKS] = std::array::from_fn(|i| y[i]);
        let beta: [f64; LINKS] = std::array::from_fn(|i| y[LINKS + i]);
        let poses = joint_poses(&ROBOT, &angles).expect("angles");
        let a = forward_dynamics(&ROBOT, &poses, &beta, &[0.0; LINKS], None).expect("regular");
        rates[..LINKS].copy_from_slice(&beta);
        rates[LINKS..].copy_from_slice(&a);
    };
    let start = [[BEND; LINKS], [0.0; LINKS]].concat();
    let method = ExplicitRungeKutta::dop853().rtol(1e-13).atol(1e-13).max_steps(1_000_000);
    let solution = IVP::ode_from_fn(rates, 0.0, SECONDS, start).method(method).solve();
    let solution = solution.expect("a solution");
    let (_, end) = solution.last().expect("an end");
    let poses = joint_poses(&ROBOT, &std::array::from_fn(|i| end[i])).expect("angles");
    body_poses(&ROBOT, &poses).iter().map(|pose| pose.position.into()).collect()
}

#[test]
fn the_simulator_converges_to_forward_dynamics() {
    let exact = reference();
    let error = |steps: usize| {
        let still = vec![[0.0; 7]; LINKS];
        let system = CHAIN.system().expect("a system");
        let h = SECONDS / steps as f64;
        let mut simulation =
            Simulation::new(system, h, &CHAIN.bent(BEND), &still).expect("a start");
        for _ in 0..steps {
            simulation.step().expect("a step");
        }
        let states = simulation.states();
        let apart = states
            .iter()
            .zip(&exact)
            .map(|(x, y)| (0..3).map(|i| (x[i] - y[i]).powi(2)).sum::<f64>());
        apart.sum::<f64>().sqrt()
    };
    let steps = [500, 1000, 2000, 5000];
    let errors = steps.map(error);
    let slope = (errors[0] / errors[3]).ln() / 10.0_f64.ln();
    println!("errors {errors:?}, order {slope:.4}");
    assert!((slope - 2.0).abs() < 0.03, "{slope}: {errors:?}");
    assert!(errors[3] < 1e-4, "{errors:?}");
}

//! Forces: motors, springs, dampers, stops, wrenches.

use differential_equations::prelude::{ExplicitRungeKutta, IVP};
use nalgebra::Vector3;
use surefoot::dynamics::{body_poses, forward_dynamics, joint_poses};
use surefoot::model::robots::biped::TREE;
use surefoot::spatial::{Quaternion, Wrench};
use surefoot_sim::multibody::{
    Chain, ChainJoint, JointLaw, Simulation, Stops, states_of_tree, system_of_tree,
};

const SECONDS: f64 = 0.4;
/// Pulls at the central body's centre of mass, world frame.
const PULL: [f64; 3] = [30.0, -12.0, 700.0];
const LAW: JointLaw = JointLaw { stiffness: 20.0, rest: 0.1, damping: 0.8, stops: None };

fn start() -> ([f64; 19], [f64; 18]) {
    let mut q: [f64; 19] = std::array::from_fn(|i| 0.4 * (1.3 * i as f64 + 0.2).sin());
    let turn = Quaternion::from_axis_angle(Vector3::new(0.6, 0.0, 0.8), 0.5);
    q[3..7].copy_from_slice(&turn.to_array());
    (q, std::array::from_fn(|i| 0.5 * (1.1 * i as f64 + 0.4).sin()))
}

fn torque(joint: usize) -> f64 {
    6.0 * (0.7 * joint as f64).sin()
}

/// The biped under motors, springs, dampers and a pull, by `core`'s forward dynamics under an adaptive
/// method of eighth order: centres of mass at the end.
fn reference() -> Vec<Vector3<f64>> {
    let rates = |_: f64, y: &Vec<f64>, rates: &mut Vec<f64>| {
        let q: [f64; 19] = std::array::from_fn(|i| y[i]);
        let v: [f64; 18] = std::array::from_fn(|i| y[19 + i]);
        let poses = joint_poses(&TREE, &q).expect("a configuration");
        let bodies = body_poses(&TREE, &poses);
        let tau: [f64; 18] = std::array::from_fn(|i| match i.checked_sub(6) {
            None => 0.0,
            Some(j) => torque(j) - LAW.stiffness * (q[7 + j] - LAW.rest) - LAW.damping * v[6 + j],
        });
        let mut wrenches = [Wrench::zero(); 13];
        wrenches[0].force = bodies[0].rotation.tr_mul(&Vector3::from(PULL));
        let a = forward_dynamics(&TREE, &poses, &v, &tau, Some(&wrenches)).expect("regular");
        let turn = Quaternion::from_array([q[3], q[4], q[5], q[6]]);
        let along = bodies[0].rotation * Vector3::new(v[0], v[1], v[2]);
        rates[..3].copy_from_slice(along.as_slice());
        rates[3..7].copy_from_slice(&turn.rate(Vector3::new(v[3], v[4], v[5])).to_array());
        rates[7..19].copy_from_slice(&v[6..]);
        rates[19..].copy_from_slice(&a);
    };
    let (q, v) = start();
    let method = ExplicitRungeKutta::dop853().rtol(1e-12).atol(1e-12).max_steps(1_000_000);
    let begin = [&q[..], &v[..]].concat();
    let solution = IVP::ode_from_fn(rates, 0.0, SECONDS, begin).method(method).solve();
    let solution = solution.expect("a solution");
    let (_, end) = solution.last().expect("an end");
    let poses = joint_poses(&TREE, &std::array::from_fn(|i| end[i])).expect("a configuration");
    body_poses(&TREE, &poses).iter().map(|pose| pose.position).collect()
}

#[test]
fn a_driven_robot_converges_to_forward_dynamics() {
    let exact = reference();
    let (q, v) = start();
    let (states, rates) = states_of_tree(&TREE, &q, &v).expect("a configuration");
    let error = |steps: u32| {
        let mut system = system_of_tree(&TREE).expect("a system");
        for k in 1..13 {
            system = system.with_law(k, LAW).expect("a hinge");
        }
        let h = SECONDS / f64::from(steps);
        let mut simulation = Simulation::new(system, h, &states, &rates).expect("a start");
        for k in 1..13 {
            simulation.set_torque(k, torque(k - 1));
        }
        simulation.set_wrench(0, PULL, [0.0; 3]);
        for _ in 0..steps {
            simulation.step().expect("a step");
        }
        let apart = simulation.states().into_iter().zip(&exact);
        apart.map(|(x, y)| (Vector3::new(x[0], x[1], x[2]) - y).norm()).fold(0.0, f64::max)
    };
    let (coarse, fine) = (error(200), error(1600));
    let order = (coarse / fine).log2() / 3.0;
    println!("{coarse:.1e} m, {fine:.1e} m: order {order:.3}");
    assert!((order - 2.0).abs() < 0.03, "{order}");
    assert!(fine < 1e-5, "{fine}");
}

/// A hinge between two stops: what it loses there it gets back, for as long as one likes.
#[test]
fn stops_keep_the_energy_and_hold_the_joint() {
    let chain = Chain {
        links: 1,
        mass: 1.0,
        length: 0.5,
        radius: 0.05,
        joint: ChainJoint::Revolute,
        floats: false,
        gravity: 9.81,
    };
    let stops = Some(Stops { low: -1.0, high: -0.4, stiffness: 500.0 });
    let law = JointLaw { stops, ..JointLaw::default() };
    let system = chain.system().expect("a system").with_law(0, law).expect("a hinge");
    let mut simulation =
        Simulation::new(system, 2e-3, &chain.bent(0.0), &[[0.0; 7]]).expect("a start");
    let energy = |simulation: &mut Simulation| {
        let (kinetic, potential) = simulation.energies().expect("regular");
        kinetic + potential
    };
    let first = energy(&mut simulation);
    let (mut low, mut high, mut band) = (0.0_f64, f64::NEG_INFINITY, 0.0_f64);
    for _ in 0..20_000 {
        simulation.step().expect("a step");
        low = low.min(simulation.angle(0));
        high = high.max(simulation.angle(0));
        band = band.max((energy(&mut simulation) - first).abs());
    }
    println!("angles {low:.3} to {high:.3}, energy {first:.2} J ± {band:.1e}");
    // It starts 0.4 rad beyond a stop, which throws it: 40 J against 2.5 J of gravity.
    assert!(low < -1.3 && low > -1.5, "{low}");
    assert!(high < 0.1, "{high}");
    assert!(band < 0.02 * first.abs().max(40.0), "{band}");
}

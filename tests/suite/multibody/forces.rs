//! Forces: motors, springs, dampers, stops, wrenches.

use differential_equations::prelude::{ExplicitRungeKutta, IVP};
use nalgebra::Vector3;
use surefoot::dynamics::{body_poses, forward_dynamics, joint_poses};
use surefoot::model::Tree;
use surefoot::model::robots::biped;
use surefoot::spatial::{Quaternion, Wrench};
use surefoot_multibody::{
    Chain, ChainJoint, JointConstraint, JointLaw, Simulation, Stops, states_of_tree, system_of_tree,
};

const SECONDS: f64 = 0.4;
/// Pulls at the central body's centre of mass, world frame.
const PULL: [f64; 3] = [30.0, -12.0, 700.0];
const LAW: JointLaw = JointLaw { stiffness: 20.0, rest: 0.1, damping: 0.8, ..JointLaw::NONE };

fn start() -> ([f64; 19], [f64; 18]) {
    let mut q: [f64; 19] = std::array::from_fn(|i| 0.4 * (1.3 * i as f64 + 0.2).sin());
    let turn = Quaternion::from_axis_angle(Vector3::new(0.6, 0.0, 0.8), 0.5);
    q[3..7].copy_from_slice(&turn.to_array());
    (q, std::array::from_fn(|i| 0.5 * (1.1 * i as f64 + 0.4).sin()))
}

fn torque(joint: usize) -> f64 {
    6.0 * (0.7 * joint as f64).sin()
}

type Biped = Tree<f64, 13, 19, 18>;

/// The biped with a rotor in each joint.
fn geared() -> Biped {
    let mut links = [biped::CENTRAL; 13];
    let (left, right) = (biped::leg(2, [0.0, -0.15]), biped::leg(8, [0.0, 0.15]));
    for k in 0..6 {
        let rotor = 0.05 + 0.1 * k as f64;
        links[1 + k] = left[k].rotor_inertia(rotor);
        links[7 + k] = right[k].rotor_inertia(1.5 * rotor);
    }
    Tree::new(links)
}

/// The biped under motors, springs, dampers and a pull, by `core`'s forward dynamics under an adaptive
/// method of eighth order: centres of mass at the end.
fn reference(tree: &Biped) -> Vec<Vector3<f64>> {
    let rates = |_: f64, y: &Vec<f64>, rates: &mut Vec<f64>| {
        let q: [f64; 19] = std::array::from_fn(|i| y[i]);
        let v: [f64; 18] = std::array::from_fn(|i| y[19 + i]);
        let poses = joint_poses(tree, &q).expect("a configuration");
        let bodies = body_poses(tree, &poses);
        let tau: [f64; 18] = std::array::from_fn(|i| match i.checked_sub(6) {
            None => 0.0,
            Some(j) => torque(j) - LAW.stiffness * (q[7 + j] - LAW.rest) - LAW.damping * v[6 + j],
        });
        let mut wrenches = [Wrench::zero(); 13];
        wrenches[0].force = bodies[0].rotation.tr_mul(&Vector3::from(PULL));
        let a = forward_dynamics(tree, &poses, &v, &tau, Some(&wrenches)).expect("regular");
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
    let poses = joint_poses(tree, &std::array::from_fn(|i| end[i])).expect("a configuration");
    body_poses(tree, &poses).iter().map(|pose| pose.position).collect()
}

#[test]
fn a_driven_robot_converges_to_forward_dynamics() {
    let ends = [biped::TREE, geared()].map(|tree| converges(&tree));
    let apart = ends[0].iter().zip(&ends[1]).map(|(a, b)| (a - b).norm());
    let apart = apart.fold(0.0, f64::max);
    assert!(apart > 1e-2, "{apart} m by the rotors");
}

/// Where its bodies end.
fn converges(tree: &Biped) -> Vec<Vector3<f64>> {
    let exact = reference(tree);
    let (q, v) = start();
    let (states, rates) = states_of_tree(tree, &q, &v).expect("a configuration");
    let error = |steps: u32| {
        let mut system = system_of_tree(tree).expect("a system");
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
    exact
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

/// Two bodies on a slider and a hinge, each with a rotor: their total energy stays, and is that of masses so much larger.
#[test]
fn rotors_hold_energy() {
    let rotor = |rotor_inertia| JointLaw { rotor_inertia, ..JointLaw::default() };
    let chain = |joint| Chain {
        links: 1,
        mass: 2.0,
        length: 0.5,
        radius: 0.05,
        joint,
        floats: false,
        gravity: 9.81,
    };
    let hinge = chain(ChainJoint::Revolute);
    let start = hinge.bent(1.0);
    let system = hinge.system().expect("a system").with_law(0, rotor(0.7)).expect("a hinge");
    let inertia = {
        let link = system.links()[0];
        let JointConstraint::Revolute { axis } = link.joint.constraint else { panic!("a hinge") };
        let arm = Vector3::from(link.joint.outboard).norm_squared();
        let own: f64 = axis.iter().zip(link.body.inertia).map(|(a, i)| a * a * i).sum();
        own + link.body.mass * arm
    };
    let mut simulation = Simulation::new(system, 1e-3, &start, &[[0.0; 7]]).expect("a start");
    let total = |simulation: &mut Simulation| {
        let (kinetic, potential) = simulation.energies().expect("regular");
        kinetic + potential
    };
    let first = total(&mut simulation);
    let mut worst = [0.0_f64; 2];
    for _ in 0..2000 {
        simulation.step().expect("a step");
        let (kinetic, _) = simulation.energies().expect("regular");
        let rates = simulation.rates().expect("regular");
        let measured = simulation.system().kinetic_energy(&simulation.states(), &rates);
        worst[0] = worst[0].max((kinetic - measured).abs());
        worst[1] = worst[1].max((total(&mut simulation) - first).abs());
    }
    // ¼ of the way down and back, against a hinge without the rotor.
    let rate = simulation.column_rates().expect("regular")[0];
    let kinetic = simulation.energies().expect("regular").0;
    assert!((kinetic - 0.5 * (inertia + 0.7) * rate * rate).abs() < 1e-12 * kinetic.max(1.0));
    println!("{worst:?}");
    assert!(worst[0] < 1e-13 && worst[1] < 1e-5, "{worst:?}");
}

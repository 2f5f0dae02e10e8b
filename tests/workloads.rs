//! The work that benches and instruction counts measure, declared once: algorithm × model × scalar.

use crate::chains::chain;
use crate::motions::{MotionStart, biped_in_flight, biped_on_feet, hanging_chain};
use nalgebra::Vector3;
use std::cell::RefCell;
use std::hint::black_box;
use surefoot::Real;
use surefoot::balance::{Controller, LeggedRobot, Reference, RobotState, WorkspaceForm, tick};
use surefoot::dynamics::{
    forward_dynamics, forward_kinematics, inverse_dynamics, joint_poses, mass_matrix,
};
use surefoot::estimate::{
    Estimator, EstimatorState, FootKind, FootReading, ImuReading, Readings, StartPose,
};
use surefoot::model::Tree;
use surefoot::model::robots::biped;
use surefoot::spatial::{Quaternion, Twist};
use surefoot_mechanics::integrators::{Method, start_free_body, start_natural};
use surefoot_mechanics::systems::{DoubleSphericalPendulum, FreeRigidBody};
use surefoot_multibody::{
    Body, ConstrainedSimulation, Joint, JointConstraint, Link, Simulation, System,
};
use surefoot_sim::closed_loop::{Scalar, controller, plant, run_plant};
use surefoot_sim::plant::Plant;
use surefoot_sim::scene::{ModelChoice, load};

/// One call of an algorithm, joint poses included.
pub struct Workload {
    /// `algorithm/model/scalar`
    pub name: String,
    /// Makes one call.
    pub call: Box<dyn Fn()>,
}

/// Angles and rates that are no special case.
pub(crate) fn wave<T: Real, const M: usize>(phase: f64) -> [T; M] {
    std::array::from_fn(|i| T::of(0.5 * (1.3 * i as f64 + phase).sin()))
}

fn on_tree<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    model: &str,
    scalar: &str,
    tree: &'static Tree<T, N, NQ, NV>,
    q: [T; NQ],
) -> Vec<Workload> {
    let v: [T; NV] = wave(0.4);
    let a: [T; NV] = wave(0.9);
    let named = |algorithm: &str, call: Box<dyn Fn()>| Workload {
        name: format!("{algorithm}/{model}/{scalar}"),
        call,
    };
    let poses = move || joint_poses(tree, black_box(&q)).expect("finite");
    vec![
        named(
            "forward-kinematics",
            Box::new(move || {
                let kinematics = forward_kinematics(tree, &poses(), black_box(&v), black_box(&a));
                black_box(&kinematics);
            }),
        ),
        named(
            "inverse-dynamics",
            Box::new(move || {
                let torques = inverse_dynamics(tree, &poses(), black_box(&v), black_box(&a), None);
                black_box(&torques);
            }),
        ),
        named(
            "forward-dynamics",
            Box::new(move || {
                let result = forward_dynamics(tree, &poses(), black_box(&v), black_box(&a), None);
                black_box(&result);
            }),
        ),
        named(
            "mass-matrix",
            Box::new(move || {
                black_box(&mass_matrix(tree, &poses()));
            }),
        ),
    ]
}

/// A configuration of the biped that is no special case.
pub fn biped_positions<T: Real>() -> [T; 19] {
    let mut q: [T; 19] = wave(0.2);
    let turn = [0.999_048_221_581_857_8, 0.0, -0.043_619_387_365_336, 0.0];
    for (to, from) in q[3..7].iter_mut().zip(turn) {
        *to = T::of(from);
    }
    q
}

fn on_biped<T: Real>(
    scalar: &str,
    tree: &'static biped::Biped<T>,
    robot: &'static LeggedRobot<T, 2>,
) -> Vec<Workload> {
    let mut all = on_tree("biped", scalar, tree, biped_positions());
    let leg = [0.05, 0.6, 0.1, -1.3, 0.05, 0.7].map(T::of);
    let state = RobotState {
        position: Vector3::new(T::of(0.01), T::of(-0.02), T::of(1.04)),
        orientation: Quaternion::from_array(
            [0.999_048_221_581_857_8, 0.0, -0.043_619_387_365_336, 0.0].map(T::of),
        ),
        velocity: Twist::from_array(wave(0.1)),
        joint_angles: [leg, leg],
        joint_rates: [wave(0.5), wave(0.7)],
    };
    let reference = Reference::at_rest(
        Vector3::new(T::of(-0.01), T::zero(), T::of(1.1)),
        Quaternion::identity(),
    );
    for (form, name) in [
        (WorkspaceForm::FixedFoot, "tick-fixed-foot"),
        (WorkspaceForm::BigBase { factor: T::of(1e3) }, "tick-big-base"),
    ] {
        let mut controller = Controller::new(robot);
        controller.form = form;
        all.push(Workload {
            name: format!("{name}/biped/{scalar}"),
            call: Box::new(move || {
                let command =
                    tick(black_box(&controller), black_box(&state), black_box(&reference));
                assert!(black_box(command).is_ok());
            }),
        });
    }
    all
}

static TREE: biped::Biped<f64> = biped::TREE;
static TREE_F32: biped::Biped<f32> = biped::TREE_F32;
static ROBOT: LeggedRobot<f64, 2> = LeggedRobot::new(&biped::TREE);
static ROBOT_F32: LeggedRobot<f32, 2> = ROBOT.to_f32();

/// A chain's workloads in both scalars; the trees live as long as the program.
fn on_chain<const N: usize>() -> Vec<Workload> {
    let double: &'static Tree<f64, N, N, N> = Box::leak(Box::new(chain::<N>()));
    let single: &'static Tree<f32, N, N, N> = Box::leak(Box::new(double.to_f32()));
    let model = format!("chain-{N}");
    let mut all = on_tree(&model, "f64", double, wave(0.2));
    all.extend(on_tree(&model, "f32", single, wave(0.2)));
    all
}

/// Steps of a hanging chain, by the multibody simulator and by the one with constraints.
fn on_rods(links: usize) -> [Workload; 2] {
    let start = hanging_chain(links, 0.1, 0.05);
    let mut simulation = start.simulation(1e-3);
    // Past the first steps, for which there is nothing to guess from.
    for _ in 0..20 {
        simulation.step().expect("a step");
    }
    let simulation = RefCell::new(simulation);
    let MotionStart { name, system, states, rates } = start;
    let oracle = ConstrainedSimulation::new(system, 1e-3, states, rates).expect("a start");
    let oracle = RefCell::new(oracle);
    [
        Workload {
            name: format!("multibody-step/{name}/f64"),
            call: Box::new(move || simulation.borrow_mut().step().expect("a step")),
        },
        Workload {
            name: format!("constrained-step/{name}/f64"),
            call: Box::new(move || oracle.borrow_mut().step().expect("a step")),
        },
    ]
}

/// Steps of the biped in flight, and standing.
fn on_multibody_biped() -> [Workload; 2] {
    let mut on_feet = biped_on_feet().simulation(1e-3);
    for _ in 0..500 {
        on_feet.step().expect("a step");
    }
    [("flight", biped_in_flight().simulation(1e-3)), ("feet", on_feet)].map(|(name, start)| {
        let simulation = RefCell::new(start);
        Workload {
            name: format!("multibody-step/biped-{name}/f64"),
            call: Box::new(move || simulation.borrow_mut().step().expect("a step")),
        }
    })
}

/// Steps of a single free body that turns: as a system of one link, and by chapter 2's method of four coordinates
/// and one constraint, which knows no position.
fn on_free_body() -> [Workload; 2] {
    let inertia = [0.2, 0.3, 0.45];
    let joint = Joint {
        outboard: [0.0; 3],
        inboard: [0.0; 3],
        home: [1.0, 0.0, 0.0, 0.0],
        constraint: JointConstraint::Floating,
    };
    let body = Body { mass: 2.0, inertia };
    let system = System::new(vec![Link { inboard: None, joint, body }], 9.81).expect("a system");
    let q = [1.0, 0.0, 0.0, 0.0];
    let q_dot = FreeRigidBody::rate(&q, &[0.5, -2.0, 1.0]);
    let state = [0.0, 0.0, 3.0, q[0], q[1], q[2], q[3]];
    let rate = [0.3, 0.1, 1.0, q_dot[0], q_dot[1], q_dot[2], q_dot[3]];
    let one = Simulation::new(system, 1e-3, &[state], &[rate]).expect("a start");
    let turning = FreeRigidBody { inertia };
    let turning = start_free_body(Method::Variational, turning, 1e-3, q, q_dot).expect("a start");
    let (one, turning) = (RefCell::new(one), RefCell::new(turning));
    [
        Workload {
            name: "multibody-step/free-body/f64".to_owned(),
            call: Box::new(move || one.borrow_mut().step().expect("a step")),
        },
        Workload {
            name: "variational-step/free-body/f64".to_owned(),
            call: Box::new(move || turning.borrow_mut().step().expect("a step")),
        },
    ]
}

/// Steps of the standing biped under the torques that hold it, on the floor and with welded feet, with all bodies
/// and lumped. A plant stands when it is called first.
fn on_plants() -> impl Iterator<Item = Workload> {
    let feet = [("floor", "experiment-1"), ("welded", "experiment-1-welded")];
    let models = [("full", ModelChoice::Full), ("lumped", ModelChoice::Lumped)];
    feet.into_iter().flat_map(move |(on, scene)| {
        models.map(|(name, model)| {
            let standing = RefCell::new(None);
            Workload {
                name: format!("plant-step/{on}-{name}/f64"),
                call: Box::new(move || {
                    let mut standing = standing.borrow_mut();
                    let (plant, torques) = standing.get_or_insert_with(|| stand(scene, model));
                    plant.step(STANDING_STEP, torques, None).expect("a step");
                }),
            }
        })
    })
}

/// Step of the scenes that are stood in, s.
const STANDING_STEP: f64 = 2e-3;

/// After a second of Experiment 1, with the torques then.
fn stand(scene: &str, model: ModelChoice) -> (Box<dyn Plant>, Vec<f64>) {
    let mut scene = load(scene).expect("a built-in scene");
    (scene.duration_s, scene.model) = (1.0, model);
    scene.integrator.step_s = STANDING_STEP;
    let mut plant = plant(&scene).expect("a plant");
    let mut controller = controller(&scene, Scalar::F64);
    let run = run_plant(&scene, plant.as_mut(), controller.as_mut(), None, &mut |_| {});
    (plant, run.samples.last().expect("samples").torques.clone())
}

/// Steps of both methods of table 2.2 at its middle step.
fn on_double_pendulum() -> [Workload; 2] {
    let pendulum = DoubleSphericalPendulum::PRINTED;
    let (q, v) = pendulum.printed_start();
    [("dvp", Method::VelocityShake), ("em", Method::EnergyMomentum)].map(|(name, method)| {
        let start = start_natural::<_, f64, 6, 2, 8>(method, pendulum, 1e-2, q, v);
        let motion = RefCell::new(start.expect("a start"));
        Workload {
            name: format!("{name}-step/double-pendulum/f64"),
            call: Box::new(move || motion.borrow_mut().step().expect("a step")),
        }
    })
}

/// Everything that is measured.
pub fn workloads() -> Vec<Workload> {
    let mut all = on_biped("f64", &TREE, &ROBOT);
    all.extend(on_biped("f32", &TREE_F32, &ROBOT_F32));
    all.extend(on_chain::<6>());
    all.extend(on_chain::<12>());
    all.extend(on_chain::<25>());
    all.extend(on_chain::<50>());
    all.extend(on_chain::<100>());
    all.extend(on_chain::<200>());
    all.extend([25, 100, 400, 1000].into_iter().flat_map(on_rods));
    all.extend(on_multibody_biped());
    all.extend(on_free_body());
    all.extend(on_plants());
    all.extend(on_double_pendulum());
    all.push(estimator::<f32>("f32"));
    all.push(estimator::<f64>("f64"));
    all
}

/// The state estimator of a robot that stands on two soles, which are measured in turn.
fn estimator<T: Real>(scalar: &str) -> Workload {
    let settings = Estimator::<T, 2>::new(T::of(2e-3), T::of(9.81), [Some(FootKind::Sole); 2]);
    let foot = |y: f64| FootReading {
        position: Vector3::new(T::of(0.02), T::of(y), T::of(-0.9)),
        orientation: Quaternion::identity(),
        is_pressed: true,
        is_planned: true,
    };
    let imu = ImuReading {
        accelerometer: Vector3::new(T::of(0.1), T::of(-0.1), T::of(9.9)),
        gyroscope: Vector3::repeat(T::of(0.01)),
    };
    let readings = Readings { imu, feet: [foot(0.1), foot(-0.1)], feet_force: None };
    let start = EstimatorState::start(&settings, &readings, &StartPose::origin());
    let state = RefCell::new(start.expect("at rest"));
    let call = move || {
        let report = settings.step(&mut state.borrow_mut(), black_box(&readings));
        black_box(report.is_ok());
    };
    Workload { name: format!("state-estimate/two-soles/{scalar}"), call: Box::new(call) }
}

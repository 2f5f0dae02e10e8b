//! Step against speed: a spinning body, a pendulum, a chain afloat.

use super::axis::Axis;
use super::column::Map;
use super::yielding::steps_of;
use crate::stability::{Problem, TreeProblemError, floating_chain};
use surefoot_mechanics::integrators::Method;
use surefoot_mechanics::systems::{DoubleSphericalPendulum, FreeRigidBody};
use surefoot_sim::scene::{AnyScene, Mechanism, open};

/// Angular velocity's direction: that of (2.52).
const SPIN: [f64; 3] = [0.0, 0.6, 0.8];
/// rad/s
const SPINS: [f64; 2] = [0.5, 50.0];
/// Multiples of the printed start's velocity.
const SWINGS: [f64; 2] = [0.1, 10.0];
/// Steps, s.
const STEPS: [f64; 2] = [0.006, 1.2];
/// Simulated time of the chain, s.
const CHAIN_S: f64 = 2.0;

fn step(cells: usize) -> Axis {
    Axis::logarithmic("step", "ms", STEPS).shown(1e3).cells(cells)
}

/// The maps of this module.
///
/// # Errors
/// Never for the scenes as shipped.
pub fn method_maps(cells: usize) -> Result<Vec<Map>, TreeProblemError> {
    let body = |name, method: Method| Map {
        name,
        title: format!("A spinning free body, {}", method.name()),
        note: "A cell works if 30 s keep energy within a tenth of the largest kinetic energy, and constraints \
               within a hundredth of their terms.",
        x: Axis::logarithmic("angular velocity", "rad/s", SPINS).cells(cells),
        y: step(cells),
        stack: Box::new(move |speed| {
            let omega = SPIN.map(|w| w * speed);
            steps_of(Problem::free_body("body", "", FreeRigidBody::PRINTED, omega), method)
        }),
    };
    let pendulum = |name, method: Method| Map {
        name,
        title: format!("A double spherical pendulum, {}", method.name()),
        note: "A cell works if 30 s keep energy within a tenth of the largest kinetic energy, and constraints \
               within a hundredth of their terms.",
        x: Axis::logarithmic("start's velocity, of that of §2.4.2", "×", SWINGS).cells(cells),
        y: step(cells),
        stack: Box::new(move |scale| {
            let system = DoubleSphericalPendulum::PRINTED;
            let (x, v) = system.printed_start();
            let start = (x, v.map(|v| v * scale));
            steps_of(Problem::natural::<_, 6, 2, 8>("pendulum", "", system, start), method)
        }),
    };
    let scene = match open("chain")? {
        AnyScene::Mechanism(scene) => scene,
        AnyScene::Robot(scene) => return Err(TreeProblemError::Robot { name: scene.name }),
    };
    debug_assert!(matches!(scene.mechanism, Mechanism::Chain { .. }));
    let chain = floating_chain(&scene, CHAIN_S)?;
    Ok(vec![
        body("step-speed-body-variational", Method::Variational),
        body("step-speed-body-lie-group", Method::LieGroup),
        body("step-speed-body-yoshida-4", Method::Yoshida4),
        body("step-speed-body-runge-kutta-4", Method::RungeKutta4Projected),
        pendulum("step-speed-pendulum-rattle", Method::Rattle),
        pendulum("step-speed-pendulum-energy-momentum", Method::EnergyMomentum),
        pendulum("step-speed-pendulum-yoshida-4", Method::Yoshida4),
        pendulum("step-speed-pendulum-runge-kutta-4", Method::RungeKutta4Projected),
        Map {
            name: "step-speed-chain",
            title: "Ten rods on ball joints, afloat and turning, variational method".to_owned(),
            note: "A cell works if the chain is followed for 2 s without a failed step, and keeps its energy \
                   within a tenth.",
            x: Axis::logarithmic("speed, of 1.36 rad/s", "×", SWINGS).cells(cells),
            y: step(cells),
            stack: Box::new(move |speed| {
                steps_of(chain.faster(speed).problem("chain", ""), Method::Variational)
            }),
        },
    ])
}

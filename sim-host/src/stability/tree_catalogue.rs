//! Trees of bodies, and robots, whose limits are sought: the built-in scenes.

use super::loop_limits::Criterion;
use super::problem::Problem;
use super::standing::standing;
use super::trees::TreeMotion;
use surefoot_mechanics::integrators::StepError;
use surefoot_multibody::ChainJoint;
use surefoot_sim::mechanism::{StartFailure, start_bodies};
use surefoot_sim::scene::{AnyScene, Mechanism, MechanismScene, SceneError, load, open};

/// Steps in which scenes are set up, s; they are left again before the first.
const SET_UP_S: f64 = 1e-3;

/// Why a scene is no problem.
#[derive(Debug, thiserror::Error)]
pub enum TreeProblemError {
    /// It cannot be read.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// It cannot be started.
    #[error(transparent)]
    Start(#[from] StartFailure),
    /// Its rates are not known at the start.
    #[error(transparent)]
    Step(#[from] StepError),
    /// It is a robot under its controller.
    #[error("{name} is no mechanism")]
    Robot {
        /// The scene.
        name: String,
    },
}

/// All problems of the multibody simulator, and the standing robot on both plants.
///
/// # Errors
/// Never for the scenes as shipped: a test makes them all.
pub fn tree_problems() -> Result<Vec<Problem>, TreeProblemError> {
    let built_in = |name: &str| match open(name)? {
        AnyScene::Mechanism(scene) => Ok(scene),
        AnyScene::Robot(scene) => Err(TreeProblemError::Robot { name: scene.name }),
    };
    let chain = built_in("chain")?;
    let experiment = load("experiment-1")?;
    let least_s = Criterion::default().least_duration_s;
    Ok(vec![
        motion_of(&chain, 5.0)?.problem("chain", "ten hanging rods, let go bent, 5 s"),
        floating_chain(&chain, 5.0)?
            .problem("floating-chain", "ten rods on ball joints, afloat and turning, 5 s"),
        motion_of(&built_in("biped-flight")?, 5.0)?
            .problem("biped-flight", "the biped afloat, limbs in motion, 5 s"),
        motion_of(&built_in("four-bar")?, 5.0)?
            .problem("four-bar", "a four-bar linkage, let go, 5 s"),
        motion_of(&built_in("box-drop")?, 1.5)?
            .problem("box-drop", "the box of §5.3, thrown onto a rubber floor, 1.5 s"),
        standing(experiment, least_s),
    ])
}

/// The motion of a mechanism's scene, for some seconds.
///
/// # Errors
/// A [`TreeProblemError`].
pub fn motion_of(scene: &MechanismScene, duration_s: f64) -> Result<TreeMotion, TreeProblemError> {
    let mut simulation = start_bodies(&scene.mechanism, SET_UP_S)?;
    let (states, rates) = (simulation.states(), simulation.rates()?);
    Ok(TreeMotion { system: simulation.system().clone(), states, rates, duration_s })
}

/// The rods of a chain's scene on ball joints, afloat without gravity and turning as one at 1.36 rad/s.
///
/// # Errors
/// A [`TreeProblemError`].
pub fn floating_chain(
    chain: &MechanismScene,
    duration_s: f64,
) -> Result<TreeMotion, TreeProblemError> {
    let mut floating = chain.clone();
    if let Mechanism::Chain { floats, gravity_m_s2, joint, .. } = &mut floating.mechanism {
        (*floats, *gravity_m_s2, *joint) = (true, 0.0, ChainJoint::Spherical);
    }
    Ok(turning(motion_of(&floating, duration_s)?))
}

/// The same motion, all bodies turning about the origin as one.
fn turning(motion: TreeMotion) -> TreeMotion {
    const OMEGA: [f64; 3] = [0.7, 1.1, -0.4];
    let rates = motion.states.iter().map(|x| rate_of_turning(x, OMEGA)).collect();
    TreeMotion { rates, ..motion }
}

/// Rate of a state that turns about the origin with the world's angular velocity `w`.
fn rate_of_turning(x: &[f64; 7], w: [f64; 3]) -> [f64; 7] {
    let v = [w[1] * x[2] - w[2] * x[1], w[2] * x[0] - w[0] * x[2], w[0] * x[1] - w[1] * x[0]];
    // (0, ω/2) ⋆ q
    let [s, i, j, k] = [x[3], x[4], x[5], x[6]];
    let q = [
        -0.5 * (w[0] * i + w[1] * j + w[2] * k),
        0.5 * (w[0] * s + w[1] * k - w[2] * j),
        0.5 * (w[1] * s + w[2] * i - w[0] * k),
        0.5 * (w[2] * s + w[0] * j - w[1] * i),
    ];
    [v[0], v[1], v[2], q[0], q[1], q[2], q[3]]
}

//! The problems of the chart.

use super::problem::Problem;
use super::touch_down::touch_down;
use surefoot_mechanics::integrators::Method;
use surefoot_mechanics::systems::DoubleSphericalPendulum;
use surefoot_sim::mechanism::StartFailure;
use surefoot_sim::scene::{
    AnyScene, Integrator, Link, Mechanism, MechanismScene, MotionMatters, SceneError, open,
};

/// Why there is no problem.
#[derive(Debug, thiserror::Error)]
pub enum CatalogueError {
    /// A scene is wrong.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// No motion begins.
    #[error(transparent)]
    Start(#[from] StartFailure),
}

/// Their names.
pub const PROBLEMS: [&str; 7] = [
    "rigid-body",
    "double-pendulum",
    "chain",
    "biped-flight",
    "touch-down",
    "box-drop",
    "experiment-1",
];

/// A problem of the chart by its name: a built-in scene's is that scene.
///
/// # Errors
/// A [`CatalogueError`], also for a name that is no scene's.
pub fn problem(name: &str) -> Result<Problem, CatalogueError> {
    let duration_s = match name {
        "double-pendulum" => return Ok(Problem::of_mechanism(&double_pendulum())?),
        "touch-down" => return Ok(touch_down()),
        // Long enough for a few turns, swings or steps; no longer, as chains are chaotic and boxes come
        // to rest.
        "rigid-body" => 10.0,
        "chain" | "biped-flight" => 5.0,
        "box-drop" => 0.4,
        "experiment-1" => 1.0,
        _ => return Ok(Problem::of_scene(&open(name)?)?),
    };
    let mut scene = open(name)?;
    match &mut scene {
        AnyScene::Robot(scene) => scene.duration_s = duration_s,
        AnyScene::Mechanism(scene) => scene.duration_s = duration_s,
    }
    Ok(Problem::of_scene(&scene)?)
}

/// §2.4.2's, from its printed start.
fn double_pendulum() -> MechanismScene {
    let system = DoubleSphericalPendulum::PRINTED;
    let (x, v) = system.printed_start();
    let rod = |of: &[f64; 6], k: usize| -> [f64; 3] {
        std::array::from_fn(|i| if k == 0 { of[i] } else { of[3 + i] - of[i] })
    };
    let links = (0..2).map(|k| {
        let ([x, y, z], [vx, vy, vz]) = (rod(&x, k), rod(&v, k));
        let (length, across) = (system.lengths[k], x.hypot(y));
        Link {
            mass_kg: system.masses[k],
            length_m: length,
            angles_deg: [across.atan2(-z), y.atan2(x)].map(f64::to_degrees),
            // z = −l cos θ; tan φ = y/x
            rates_deg_s: [vz / across, (x * vy - y * vx) / (across * across)].map(f64::to_degrees),
        }
    });
    MechanismScene {
        name: "double-pendulum".to_owned(),
        description: "The double spherical pendulum of §2.4.2, from its printed start".to_owned(),
        duration_s: 10.0,
        integrator: Integrator { name: Method::Variational, step_s: 0.01 },
        is_unadvised: false,
        matters: MotionMatters::default(),
        mechanism: Mechanism::Pendulum { gravity_m_s2: system.gravity, links: links.collect() },
    }
}

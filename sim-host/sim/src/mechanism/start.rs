//! From a scene to a mechanism on its way.

use super::composed::Composed;
use super::merged::NotMerged;
use super::model::{MechanismModel, Started, with_model};
use super::moving::{Moved, Moving};
use super::tree::OnTree;
use crate::plant::StepFailure;
use crate::scene::{BuildError, Link, Mechanism, MechanismScene};
use std::cell::LazyCell;
use surefoot_mechanics::forecast::{Course, foretell};
use surefoot_mechanics::integrators::{
    ADAPTIVE_TOLERANCE, DormandPrince, Method, StartError, start_free_body, start_natural,
};
use surefoot_mechanics::systems::{FreeRigidBody, Pendulum, PolarAngles};
use surefoot_mechanics::{Chart, jacobian};
use surefoot_multibody::{Chain, NotPlanar, NotSingle, Simulation, SystemError};

/// Why a scene cannot be started.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StartFailure {
    /// The method refuses it.
    #[error(transparent)]
    Method(#[from] StartError),
    /// It is no system.
    #[error(transparent)]
    System(#[from] SystemError),
    /// Its bodies and joints are none.
    #[error(transparent)]
    Bodies(#[from] BuildError),
    /// It is no state of the robot.
    #[error(transparent)]
    Robot(#[from] StepFailure),
    /// It has no links to merge.
    #[error("no merged model: {0}")]
    NotMerged(#[from] NotMerged),
    /// It does not stay in a plane.
    #[error("no planar model: {0}")]
    NotPlanar(#[from] NotPlanar),
    /// It is no single free body.
    #[error("no model of a single body: {0}")]
    NotSingle(#[from] NotSingle),
    /// It has no model to choose.
    #[error("the mechanism has one model only")]
    OneModel,
    /// Smaller models are the variational method's.
    #[error(
        "the {model} model is of the method variational, not of {method}: --integrator variational"
    )]
    ModelOfVariational {
        /// Which model.
        model: MechanismModel,
        /// The scene's method.
        method: Method,
    },
    /// A saved run is of another motion.
    #[error("the saved run is of another motion: {difference}")]
    OtherMotion {
        /// What differs.
        difference: String,
    },
    /// It has no bodies and joints.
    #[error("the mechanism has no bodies and joints")]
    NoBodies,
}

/// Starts a scene.
///
/// # Errors
/// A [`StartFailure`].
pub fn start(scene: &MechanismScene) -> Result<Box<dyn Moving>, StartFailure> {
    start_within(scene, ADAPTIVE_TOLERANCE)
}

/// The same, with the tolerance that [`Method::DormandPrince8`] is to keep.
///
/// # Errors
/// A [`StartFailure`].
pub fn start_within(
    scene: &MechanismScene,
    tolerance: f64,
) -> Result<Box<dyn Moving>, StartFailure> {
    match &scene.mechanism {
        Mechanism::RigidBody { inertia_kg_m2, orientation, angular_velocity_rad_s } => {
            let body = FreeRigidBody { inertia: *inertia_kg_m2 };
            // A file rounds it.
            let norm = orientation.iter().map(|q| q * q).sum::<f64>().sqrt();
            let q = orientation.map(|q| q / norm);
            let q_dot = FreeRigidBody::rate(&q, angular_velocity_rad_s);
            let (method, h) = (scene.integrator.name, scene.integrator.step_s);
            let duration_s = scene.duration_s;
            let mut motion = start_free_body(method, body, h, q, q_dot)?;
            if method == Method::DormandPrince8 {
                motion = Box::new(DormandPrince::<_, 4, 1, 5>::new(body, tolerance, h, q, q_dot));
            }
            Ok(Box::new(Moved::<_, 4, 1> {
                system: body,
                motion,
                // For a step of no length the discrete momentum is the continuous one.
                momentum: |body, q, v| body.discrete_momentum(q, v, 0.0).to_vec(),
                forecast_s: LazyCell::new(Box::new(move || {
                    let begin = |method, h, q, v| start_free_body(method, body, h, q, v);
                    let course = Course::along::<_, 1, 5>(&body, q, q_dot, duration_s, begin);
                    let found = foretell::<_, 4, 1>(&body, &course, method, |h, q, v| {
                        begin(method, h, q, v)
                    });
                    found.and_then(|forecast| forecast.step_s)
                })),
            }))
        }
        Mechanism::Pendulum { gravity_m_s2, links } => match links.len() {
            1 => pendulum::<1, 2, 3, 4>(scene, tolerance, *gravity_m_s2, links),
            2 => pendulum::<2, 4, 6, 8>(scene, tolerance, *gravity_m_s2, links),
            3 => pendulum::<3, 6, 9, 12>(scene, tolerance, *gravity_m_s2, links),
            // The scene's check allows no more.
            _ => pendulum::<4, 8, 12, 16>(scene, tolerance, *gravity_m_s2, links),
        },
        Mechanism::Multibody(_) | Mechanism::Biped(_) | Mechanism::Chain { .. } => {
            Ok(bodies_under(scene, tolerance, None)?.moving)
        }
    }
}

/// Starts a scene with a model of its bodies and joints: the smallest that they bear, or the one that is wanted.
///
/// # Errors
/// A [`StartFailure`], also where the scene does not bear the model, or is of a kind that has only one.
pub fn start_model(
    scene: &MechanismScene,
    wanted: Option<MechanismModel>,
) -> Result<Started, StartFailure> {
    match &scene.mechanism {
        Mechanism::RigidBody { .. } | Mechanism::Pendulum { .. } if wanted.is_some() => {
            Err(StartFailure::OneModel)
        }
        Mechanism::RigidBody { .. } | Mechanism::Pendulum { .. } => {
            Ok(Started { moving: start(scene)?, model: None })
        }
        _ => bodies_under(scene, ADAPTIVE_TOLERANCE, wanted),
    }
}

/// Bodies and joints under the scene's method: of the simulator's own there are several models.
fn bodies_under(
    scene: &MechanismScene,
    tolerance: f64,
    wanted: Option<MechanismModel>,
) -> Result<Started, StartFailure> {
    let simulation = start_bodies(&scene.mechanism, scene.integrator.step_s)?;
    let torques = scene.mechanism.torques();
    let method = scene.integrator.name;
    if method == Method::Variational {
        return with_model(simulation, &torques, wanted);
    }
    if let Some(model) = wanted.filter(|model| *model != MechanismModel::Full) {
        return Err(StartFailure::ModelOfVariational { model, method });
    }
    let moving: Box<dyn Moving> = match method {
        Method::Yoshida4 | Method::Yoshida6 => Box::new(Composed::new(method, simulation)?),
        _ => Box::new(OnTree::new(method, tolerance, simulation, &torques)?),
    };
    Ok(Started { moving, model: None })
}

/// Bodies and joints, in steps of `h`.
///
/// # Errors
/// A [`StartFailure`]: [`StartFailure::NoBodies`] for mechanisms that are no system of bodies and joints.
pub fn start_bodies(mechanism: &Mechanism, h: f64) -> Result<Simulation, StartFailure> {
    Ok(match mechanism {
        Mechanism::Multibody(bodies) => bodies.start(h)?,
        Mechanism::Biped(flight) => flight.start(h)?,
        Mechanism::Chain {
            links,
            mass_kg,
            length_m,
            radius_m,
            joint,
            floats,
            bend_deg,
            gravity_m_s2,
        } => {
            let chain = Chain {
                links: *links,
                mass: *mass_kg,
                length: *length_m,
                radius: *radius_m,
                joint: *joint,
                floats: *floats,
                gravity: *gravity_m_s2,
            };
            let (states, still) = (chain.bent(bend_deg.to_radians()), vec![[0.0; 7]; *links]);
            Simulation::new(chain.system()?, h, &states, &still)?
        }
        Mechanism::RigidBody { .. } | Mechanism::Pendulum { .. } => {
            return Err(StartFailure::NoBodies);
        }
    })
}

/// `L` links, with `M` angles, `N` coordinates, and `U` unknowns.
fn pendulum<const L: usize, const M: usize, const N: usize, const U: usize>(
    scene: &MechanismScene,
    tolerance: f64,
    gravity: f64,
    links: &[Link],
) -> Result<Box<dyn Moving>, StartFailure> {
    let system = Pendulum::<L> {
        masses: std::array::from_fn(|k| links[k].mass_kg),
        lengths: std::array::from_fn(|k| links[k].length_m),
        gravity,
    };
    let angle = |k: usize| links[k / 2].angles_deg[k % 2].to_radians();
    let rate = |k: usize| links[k / 2].rates_deg_s[k % 2].to_radians();
    let angles: [f64; M] = std::array::from_fn(angle);
    let chart = PolarAngles { lengths: system.lengths };
    let (x, slope) = jacobian(&angles, |q| chart.embed(q));
    let v: [f64; N] = slope.map(|row| row.iter().enumerate().map(|(k, s)| s * rate(k)).sum());
    let (method, h) = (scene.integrator.name, scene.integrator.step_s);
    let duration_s = scene.duration_s;
    let mut motion = start_natural::<_, f64, N, L, U>(method, system, h, x, v)?;
    if method == Method::DormandPrince8 {
        motion = Box::new(DormandPrince::<_, N, L, U>::new(system, tolerance, h, x, v));
    }
    Ok(Box::new(Moved::<_, N, L> {
        system,
        motion,
        momentum: |system, x, v| vec![system.vertical_momentum(x, v)],
        forecast_s: LazyCell::new(Box::new(move || {
            let begin = |method, h, x, v| start_natural::<_, f64, N, L, U>(method, system, h, x, v);
            let course = Course::along::<_, L, U>(&system, x, v, duration_s, begin);
            let found =
                foretell::<_, N, L>(&system, &course, method, |h, x, v| begin(method, h, x, v));
            found.and_then(|forecast| forecast.step_s)
        })),
    }))
}

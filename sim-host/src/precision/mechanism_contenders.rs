//! All methods by name on a mechanism, as `run` runs them.

use super::contender::{Contender, Foretell, Start};
use super::course::{Course, OfBodies, OfMechanism};
use super::problem::Omission;
use crate::stability::motion_of;
use std::sync::Arc;
use surefoot_mechanics::integrators::{Method, StartError, YOSHIDA_4, YOSHIDA_6, longest_stage};
use surefoot_multibody::System;
use surefoot_sim::mechanism::{StartFailure, start_bodies, start_within};
use surefoot_sim::scene::{Mechanism, MechanismScene};

/// All methods that take the mechanism, and those that do not.
///
/// # Errors
/// A [`StartFailure`] that is the scene's and not a method's.
pub(super) fn mechanism_contenders(
    scene: &MechanismScene,
) -> Result<(Vec<Contender>, Vec<Omission>), StartFailure> {
    let (mut contenders, mut omitted) = (Vec::new(), Vec::new());
    let is_natural = !matches!(scene.mechanism, Mechanism::RigidBody { .. });
    let system = match start_bodies(&scene.mechanism, scene.integrator.step_s) {
        Ok(simulation) => Some(Arc::new(simulation.system().clone())),
        Err(StartFailure::NoBodies) => None,
        Err(failure) => return Err(failure),
    };
    for method in Method::all().iter().copied() {
        let mut scene = scene.clone();
        scene.integrator.name = method;
        // A step so short that the first one, which SHAKE makes at once, cannot fail.
        scene.integrator.step_s = scene.duration_s * 1e-5;
        match start_within(&scene, 1e-3) {
            Ok(_) => {}
            Err(StartFailure::Method(StartError::NotFor { takes, .. })) => {
                omitted.push(Omission { method: method.name(), reason: format!("takes {takes}") });
                continue;
            }
            Err(failure) => return Err(failure),
        }
        let foretell = foretell(&scene, method, system.is_some());
        let start = start(scene, system.clone());
        contenders.push(match method {
            Method::DormandPrince8 => Contender::adaptive(method.name(), start),
            _ => Contender::stepping(method.name(), order(method, is_natural), start)
                .foretold_by(foretell),
        });
    }
    Ok((contenders, omitted))
}

/// The scene's method, of bodies with their system.
pub(super) fn start(scene: MechanismScene, system: Option<Arc<System>>) -> Start {
    Box::new(move |h, tolerance| {
        let mut scene = scene.clone();
        scene.integrator.step_s = h;
        let moving = start_within(&scene, tolerance)?;
        let course: Box<dyn Course> = match &system {
            Some(system) => Box::new(OfBodies { moving, system: Arc::clone(system) }),
            None => Box::new(OfMechanism(moving)),
        };
        Ok(course)
    })
}

/// Of mechanisms of chapter 2 what [`foretell`](surefoot_mechanics::forecast::foretell) says along the motion; of bodies what
/// is foretold of the simulator's steps, of which each stage of a composition is one.
fn foretell(scene: &MechanismScene, method: Method, has_bodies: bool) -> Foretell {
    let scene = scene.clone();
    let of_bodies = move |scene: &MechanismScene| {
        let longest = match method {
            Method::Variational => 1.0,
            Method::Yoshida4 => longest_stage(&YOSHIDA_4),
            Method::Yoshida6 => longest_stage(&YOSHIDA_6),
            _ => return None,
        };
        let motion = motion_of(scene, scene.duration_s).ok()?.problem("", "");
        Some(motion.forecast(Method::Variational)?.step_s? / longest)
    };
    Box::new(move || match has_bodies {
        true => of_bodies(&scene),
        false => start_within(&scene, 1e-3).ok()?.forecast_s(),
    })
}

/// The endpoint rule is of second order only where masses are constant.
fn order(method: Method, is_natural: bool) -> Option<u32> {
    match method {
        Method::VariationalEndpoint if !is_natural => Some(1),
        _ => method.order(),
    }
}

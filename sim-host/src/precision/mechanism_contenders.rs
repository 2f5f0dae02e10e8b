//! The methods of chapter 2 on its mechanisms.

use super::contender::{Contender, Start};
use super::course::{Course, OfMechanism};
use super::problem::Omission;
use crate::integrators::{Method, StartError};
use crate::mechanism::{StartFailure, start_within};
use crate::scene::{Mechanism, MechanismScene};

/// All methods that take the mechanism, and those that do not.
///
/// # Errors
/// A [`StartFailure`] that is the scene's and not a method's.
pub(super) fn mechanism_contenders(
    scene: &MechanismScene,
) -> Result<(Vec<Contender>, Vec<Omission>), StartFailure> {
    let (mut contenders, mut omitted) = (Vec::new(), Vec::new());
    let is_natural = !matches!(scene.mechanism, Mechanism::RigidBody { .. });
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
        let start: Start = Box::new(move |h, tolerance| {
            let mut scene = scene.clone();
            scene.integrator.step_s = h;
            let course: Box<dyn Course> = Box::new(OfMechanism(start_within(&scene, tolerance)?));
            Ok(course)
        });
        contenders.push(match method {
            Method::DormandPrince8 => Contender::adaptive(method.name(), start),
            _ => Contender::stepping(method.name(), order(method, is_natural), start),
        });
    }
    Ok((contenders, omitted))
}

/// The endpoint rule is of second order only where masses are constant.
fn order(method: Method, is_natural: bool) -> Option<u32> {
    match method {
        Method::VariationalEndpoint if !is_natural => Some(1),
        _ => method.order(),
    }
}

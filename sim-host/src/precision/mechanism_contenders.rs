//! The methods of chapter 2 on its mechanisms.

use super::contender::{Contender, Start};
use super::course::{Course, OfMechanism};
use super::problem::Omission;
use crate::integrators::{Method, StartError};
use crate::mechanism::{StartFailure, start_within};
use crate::scene::MechanismScene;

/// All methods that take the mechanism, and those that do not.
///
/// # Errors
/// A [`StartFailure`] that is the scene's and not a method's.
pub(super) fn mechanism_contenders(
    scene: &MechanismScene,
) -> Result<(Vec<Contender>, Vec<Omission>), StartFailure> {
    let (mut contenders, mut omitted) = (Vec::new(), Vec::new());
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
            _ => Contender::stepping(method.name(), method.order(), start),
        });
    }
    Ok((contenders, omitted))
}

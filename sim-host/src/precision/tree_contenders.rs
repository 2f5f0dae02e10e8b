//! Bodies and joints in forms of the simulator that are no methods of `run`: with constraints, and with contact
//! at midpoints.

use super::contender::{Contender, Start};
use super::course::{Course, OfConstrainedBodies};
use super::mechanism_contenders::start;
use super::problem::Omission;
use std::sync::Arc;
use surefoot_mechanics::integrators::{Method, StepError};
use surefoot_multibody::contact::Switching;
use surefoot_multibody::{ConstrainedSimulation, System};
use surefoot_sim::mechanism::{Moving, StartFailure, start_bodies};
use surefoot_sim::scene::{Mechanism, MechanismScene};

/// The form with constraints and multipliers of chapter 5.
pub const WITH_CONSTRAINTS: &str = "variational-constrained";
/// Points that enter and leave the floor at steps' midpoints, as printed.
pub const AT_MIDPOINTS: &str = "variational-at-midpoints";

/// The form with constraints, where it takes the bodies.
pub(super) fn with_constraints(
    scene: &MechanismScene,
    system: &System,
) -> Result<Contender, Omission> {
    let is_plain = system.ground().is_none()
        && system.strikers().is_empty()
        && system.laws().is_empty()
        && system.closures().is_empty()
        && scene.mechanism.torques().iter().all(|torque| *torque == 0.0);
    if !is_plain {
        let reason = "no contact, loops, springs or motors in that form".to_owned();
        return Err(Omission { method: WITH_CONSTRAINTS.to_owned(), reason });
    }
    let scene = scene.clone();
    let start: Start = Box::new(move |h, _| {
        let mut simulation = start_bodies(&scene.mechanism, h)?;
        let is_free = !Moving::conserved(&mut simulation).map_or(true, |c| c.1.is_empty());
        let (states, rates) = (simulation.states(), simulation.rates().map_err(start_failure)?);
        let system = simulation.system().clone();
        let simulation = ConstrainedSimulation::new(system, h, states, rates)?;
        let course: Box<dyn Course> = Box::new(OfConstrainedBodies { simulation, is_free });
        Ok(course)
    });
    Ok(Contender::stepping(WITH_CONSTRAINTS, Some(2), start))
}

fn start_failure(error: StepError) -> StartFailure {
    StartFailure::Method(error.into())
}

/// The printed switching of contact points, where there is contact and the scene has the other one.
pub(super) fn at_midpoints(scene: &MechanismScene, system: &System) -> Option<Contender> {
    let mut scene = scene.clone();
    scene.integrator.name = Method::Variational;
    let Mechanism::Multibody(bodies) = &mut scene.mechanism else { return None };
    if system.ground().is_none() || bodies.switching == Switching::AtMidpoint {
        return None;
    }
    bodies.switching = Switching::AtMidpoint;
    let start = start(scene, Some(Arc::new(system.clone())));
    Some(Contender::stepping(AT_MIDPOINTS, Some(2), start))
}

//! Methods on bodies and joints: the simulator's and compositions of it, the form with constraints, and
//! what others do, on `core`'s forward dynamics.

use super::contender::{Contender, Start};
use super::course::{Course, OfBodies, OfConstrainedBodies, Stages};
use super::problem::Omission;
use super::tree_course::{OfTree, TreeMethod};
use super::tree_model::tree_model;
use crate::contact::Switching;
use crate::integrators::Method;
use crate::mechanism::{Moving, StartFailure, start_bodies};
use crate::multibody::{ConstrainedSimulation, System};
use crate::scene::{Mechanism, MechanismScene};
use std::sync::Arc;

/// The form with constraints and multipliers of chapter 5.
pub const WITH_CONSTRAINTS: &str = "variational-constrained";
/// Points that enter and leave the floor at steps' midpoints, as printed.
pub const AT_MIDPOINTS: &str = "variational-at-midpoints";

/// All methods that take the bodies, and those that do not.
///
/// # Errors
/// A [`StartFailure`] that is the scene's and not a method's.
pub(super) fn tree_contenders(
    scene: &MechanismScene,
) -> Result<(Vec<Contender>, Vec<Omission>), StartFailure> {
    let mut all = Gathered { contenders: Vec::new(), omitted: Vec::new() };
    let simulation = start_bodies(&scene.mechanism, scene.integrator.step_s)?;
    let system = simulation.system().clone();
    let touches = system.ground().is_some() || !system.strikers().is_empty();
    all.push(Method::Variational.name(), Some(2), composed(scene, Stages::One));
    if touches {
        let why = "a step backwards through a contact is none";
        all.omit(Method::Yoshida4.name(), why);
        all.omit(Method::Yoshida6.name(), why);
        if let Some(printed) = at_midpoints(scene) {
            all.push(AT_MIDPOINTS.to_owned(), Some(2), composed(&printed, Stages::One));
        }
    } else {
        all.push(Method::Yoshida4.name(), Some(4), composed(scene, Stages::Yoshida4));
        all.push(Method::Yoshida6.name(), Some(6), composed(scene, Stages::Yoshida6));
    }
    with_constraints(scene, &system, &mut all);
    on_differential_equations(scene, &mut all)?;
    for method in Method::all() {
        let name = method.name();
        let is_known = all.contenders.iter().any(|c| c.name == name)
            || all.omitted.iter().any(|o| o.method == name);
        if !is_known {
            all.omit(name, "made for the mechanisms of chapter 2: a Lagrangian of few coordinates");
        }
    }
    Ok((all.contenders, all.omitted))
}

struct Gathered {
    contenders: Vec<Contender>,
    omitted: Vec<Omission>,
}

impl Gathered {
    fn push(&mut self, name: String, order: Option<u32>, start: Start) {
        self.contenders.push(Contender::stepping(name, order, start));
    }

    fn omit(&mut self, method: String, reason: impl Into<String>) {
        self.omitted.push(Omission { method, reason: reason.into() });
    }
}

fn composed(scene: &MechanismScene, stages: Stages) -> Start {
    let scene = scene.clone();
    Box::new(move |h, _| {
        let simulation = start_bodies(&scene.mechanism, h)?;
        let course: Box<dyn Course> = Box::new(OfBodies { simulation, stages });
        Ok(course)
    })
}

fn at_midpoints(scene: &MechanismScene) -> Option<MechanismScene> {
    let mut scene = scene.clone();
    let Mechanism::Multibody(bodies) = &mut scene.mechanism else { return None };
    (bodies.switching == Switching::WithinTheStep)
        .then(|| bodies.switching = Switching::AtMidpoint)?;
    Some(scene)
}

fn is_loaded(scene: &MechanismScene) -> bool {
    torques(scene).iter().any(|torque| *torque != 0.0)
}

/// Held in joints, by link.
fn torques(scene: &MechanismScene) -> Vec<f64> {
    match &scene.mechanism {
        Mechanism::Multibody(bodies) => bodies.bodies.iter().map(|body| body.torque).collect(),
        _ => Vec::new(),
    }
}

fn with_constraints(scene: &MechanismScene, system: &System, all: &mut Gathered) {
    let is_plain = system.ground().is_none()
        && system.strikers().is_empty()
        && system.laws().is_empty()
        && system.closures().is_empty()
        && !is_loaded(scene);
    if !is_plain {
        let why = "no contact, loops, springs or motors in that form";
        return all.omit(WITH_CONSTRAINTS.to_owned(), why);
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
    all.push(WITH_CONSTRAINTS.to_owned(), Some(2), start);
}

fn start_failure(error: crate::integrators::StepError) -> StartFailure {
    StartFailure::Method(error.into())
}

fn on_differential_equations(
    scene: &MechanismScene,
    all: &mut Gathered,
) -> Result<(), StartFailure> {
    let mut simulation = start_bodies(&scene.mechanism, scene.integrator.step_s)?;
    let methods = [Method::SemiImplicitEuler, Method::RungeKutta4, Method::DormandPrince8];
    let model = match tree_model(&mut simulation, &torques(scene)) {
        Ok(model) => Arc::from(model),
        Err(takes) => {
            for method in methods {
                all.omit(method.name(), format!("here it takes {takes}"));
            }
            return Ok(());
        }
    };
    let is_free = !Moving::conserved(&mut simulation).map_or(true, |c| c.1.is_empty());
    let system = Arc::new(simulation.system().clone());
    for method in methods {
        let (model, system) = (Arc::clone(&model), Arc::clone(&system));
        let start: Start = Box::new(move |h, tolerance| {
            let on_tree = match method {
                Method::SemiImplicitEuler => TreeMethod::SemiImplicitEuler,
                Method::RungeKutta4 => TreeMethod::RungeKutta4,
                _ => TreeMethod::DormandPrince8(tolerance),
            };
            let (model, system) = (Arc::clone(&model), Arc::clone(&system));
            let course: Box<dyn Course> = Box::new(OfTree::new(model, system, is_free, on_tree, h));
            Ok(course)
        });
        all.contenders.push(match method {
            Method::DormandPrince8 => Contender::adaptive(method.name(), start),
            _ => Contender::stepping(method.name(), method.order(), start),
        });
    }
    Ok(())
}

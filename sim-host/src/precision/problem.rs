//! A problem: a scene, how long it lasts, the methods that play it, and what is exact about it.

use super::closed_loop::closed_loop;
use super::contender::Contender;
use super::measure::Span;
use super::mechanism_contenders::mechanism_contenders;
use super::tree_contenders::{at_midpoints, with_constraints};
use serde::{Deserialize, Serialize};
use surefoot_multibody::System;
use surefoot_sim::mechanism::{StartFailure, start_bodies};
use surefoot_sim::scene::{AnyScene, MechanismScene};

/// A method that does not play a problem.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Omission {
    /// Its name.
    pub method: String,
    /// Why.
    pub reason: String,
}

/// What is known exactly: places at the samples, of all contenders' coordinates.
pub type ClosedForm = Box<dyn Fn(&Span) -> Vec<Vec<f64>> + Send + Sync>;

/// A problem.
pub struct Problem {
    /// Its name.
    pub name: String,
    /// What it is.
    pub description: String,
    /// When it is looked at.
    pub span: Span,
    /// The methods that play it.
    pub contenders: Vec<Contender>,
    /// Those that do not.
    pub omitted: Vec<Omission>,
    /// Whether energy should stay.
    pub keeps_energy: bool,
    /// Where there is one.
    pub closed_form: Option<ClosedForm>,
    /// Of a mechanism's scene.
    pub scene: Option<MechanismScene>,
}

/// Times at which places are compared.
pub const SAMPLES: u32 = 10;

impl Problem {
    /// A scene's problem, for its duration.
    ///
    /// # Errors
    /// A [`StartFailure`] where no motion begins.
    pub fn of_scene(scene: &AnyScene) -> Result<Self, StartFailure> {
        match scene {
            AnyScene::Robot(scene) => Ok(closed_loop(scene)),
            AnyScene::Mechanism(scene) => Self::of_mechanism(scene),
        }
    }

    /// The problem of a mechanism's scene, for its duration.
    ///
    /// # Errors
    /// A [`StartFailure`] where no motion begins.
    pub fn of_mechanism(scene: &MechanismScene) -> Result<Self, StartFailure> {
        let (mut contenders, mut omitted) = mechanism_contenders(scene)?;
        let keeps_energy = match start_bodies(&scene.mechanism, scene.integrator.step_s) {
            Err(StartFailure::NoBodies) => true,
            Err(failure) => return Err(failure),
            Ok(simulation) => {
                let system = simulation.system();
                contenders.extend(at_midpoints(scene, system));
                match with_constraints(scene, system) {
                    Ok(contender) => contenders.push(contender),
                    Err(omission) => omitted.push(omission),
                }
                keeps_energy(scene, system)
            }
        };
        Ok(Self {
            name: scene.name.clone(),
            description: scene.description.clone(),
            span: Span { duration_s: scene.duration_s, samples: SAMPLES },
            contenders,
            omitted,
            keeps_energy,
            closed_form: None,
            scene: Some(scene.clone()),
        })
    }
}

/// Nothing dissipates, and no motor works.
fn keeps_energy(scene: &MechanismScene, system: &System) -> bool {
    let is_still = scene.mechanism.torques().iter().all(|torque| *torque == 0.0);
    let is_undamped = system.laws().iter().all(|(_, law)| !law.dissipates());
    is_still && is_undamped && system.ground().is_none() && system.strikers().is_empty()
}

//! How much is computed of bodies and joints: no more than the motion needs.

use super::merged::{Merged, MergedStart, NotMerged, without_fixed_joints};
use super::moving::Moving;
use super::start::StartFailure;
use serde::{Deserialize, Serialize};
use surefoot_multibody::{
    BodyState, NotPlanar, NotSingle, PlanarError, PlanarSimulation, Simulation, SingleBody,
    SingleBodyError, SystemError,
};

/// A model of a mechanism of bodies and joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum MechanismModel {
    /// All bodies in space, in joint coordinates.
    Full,
    /// The same with links on fixed joints merged with what they are fixed to.
    Merged,
    /// In the plane that the motion stays in, likewise merged.
    Planar,
    /// One free body, likewise merged, with nothing of a tree.
    SingleBody,
}

impl std::fmt::Display for MechanismModel {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Full => "full",
            Self::Merged => "merged",
            Self::Planar => "planar",
            Self::SingleBody => "single-body",
        })
    }
}

/// The model that a motion is played with.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct ChosenModel {
    /// Which one.
    pub model: MechanismModel,
    /// Its bodies.
    pub bodies: usize,
    /// Why that one, for people.
    pub reason: String,
}

/// A motion, with its model, if there are several for its kind of mechanism.
pub struct Started {
    /// The motion.
    pub moving: Box<dyn Moving>,
    /// The model.
    pub model: Option<ChosenModel>,
}

/// Plays bodies and joints with the smallest model that they bear, or with the one that is wanted.
///
/// # Errors
/// A [`StartFailure`]: with the reason, where they do not bear the wanted one.
pub(super) fn with_model(
    mut whole: Simulation,
    torques: &[f64],
    wanted: Option<MechanismModel>,
) -> Result<Started, StartFailure> {
    let asked = || "it was asked for".to_owned();
    if wanted == Some(MechanismModel::Full) {
        let model = ChosenModel {
            model: MechanismModel::Full,
            bodies: whole.system().links().len(),
            reason: asked(),
        };
        return Ok(Started { moving: Box::new(whole), model: Some(model) });
    }
    let system = whole.system().clone();
    let start = match without_fixed_joints(&mut whole, torques)? {
        Ok(start) => start,
        Err(reason) if wanted == Some(MechanismModel::Merged) => return Err(reason.into()),
        Err(NotMerged::Singular(error)) if wanted.is_some() => {
            return Err(NotMerged::Singular(error).into());
        }
        Err(_) => MergedStart { reduced: None, torques: torques.to_vec(), simulation: whole },
    };
    let MergedStart { reduced, torques, mut simulation } = start;
    let bodies = simulation.system().links().len();
    let whole_or_merged = match reduced {
        Some(_) => MechanismModel::Merged,
        None => MechanismModel::Full,
    };
    let (moving, model, reason): (Box<dyn Moving>, _, _) = match (wanted, simulation.rates()) {
        (Some(MechanismModel::Planar), rates) => {
            let planar = planar(&simulation, &rates.map_err(NotMerged::Singular)?, &torques)?;
            (Box::new(planar?), MechanismModel::Planar, asked())
        }
        (Some(MechanismModel::SingleBody), rates) => {
            let single = single(&simulation, &rates.map_err(NotMerged::Singular)?)?;
            (Box::new(single?), MechanismModel::SingleBody, asked())
        }
        (Some(_), _) => (Box::new(simulation), whole_or_merged, asked()),
        // The first step reports it.
        (None, Err(error)) => (Box::new(simulation), whole_or_merged, error.to_string()),
        (None, Ok(rates)) => {
            let planar = planar(&simulation, &rates, &torques)?;
            let single = single(&simulation, &rates)?;
            let touches = !simulation.contacts().is_empty();
            match (planar, single) {
                // Without contacts it knows its way beforehand, which is cheaper yet than a plane.
                (Ok(_), Ok(single)) if !touches => {
                    let reason = "one free body, that touches nothing".to_owned();
                    (Box::new(single), MechanismModel::SingleBody, reason)
                }
                (Ok(planar), _) => {
                    let n = planar.plane().normal;
                    let reason = format!(
                        "the motion stays in the plane across ({:.3}, {:.3}, {:.3})",
                        n.x, n.y, n.z
                    );
                    (Box::new(planar), MechanismModel::Planar, reason)
                }
                (Err(not_planar), Ok(single)) => {
                    let reason = format!("one free body; not planar: {not_planar}");
                    (Box::new(single), MechanismModel::SingleBody, reason)
                }
                (Err(not_planar), Err(_)) => {
                    let reason = format!("not planar: {not_planar}");
                    (Box::new(simulation), whole_or_merged, reason)
                }
            }
        }
    };
    let moving: Box<dyn Moving> = match reduced {
        None => moving,
        Some(reduced) => Box::new(Merged { whole: system, reduced, moving }),
    };
    Ok(Started { moving, model: Some(ChosenModel { model, bodies, reason }) })
}

fn planar(
    from: &Simulation,
    rates: &[BodyState],
    torques: &[f64],
) -> Result<Result<PlanarSimulation, NotPlanar>, SystemError> {
    let h = from.progress().h;
    match PlanarSimulation::new(from.system().clone(), h, &from.states(), rates) {
        Err(PlanarError::System(error)) => Err(error),
        Err(PlanarError::NotPlanar(reason)) => Ok(Err(reason)),
        Ok(mut planar) => {
            for (link, torque) in torques.iter().enumerate() {
                planar.set_torque(link, *torque);
            }
            Ok(Ok(planar))
        }
    }
}

fn single(
    from: &Simulation,
    rates: &[BodyState],
) -> Result<Result<SingleBody, NotSingle>, SystemError> {
    let h = from.progress().h;
    match SingleBody::new(from.system().clone(), h, &from.states(), rates) {
        Err(SingleBodyError::System(error)) => Err(error),
        Err(SingleBodyError::NotSingle(reason)) => Ok(Err(reason)),
        Ok(body) => Ok(Ok(body)),
    }
}

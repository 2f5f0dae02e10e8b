//! `--model`: one word for robots and for mechanisms.

use clap::ValueEnum;
use surefoot_sim::mechanism::MechanismModel;
use surefoot_sim::scene::ModelChoice;

/// How much is modelled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum ModelName {
    /// The smallest that the scene bears
    Auto,
    /// All bodies, in space
    Full,
    /// Of a robot: small bodies given to their neighbours
    Lumped,
    /// Of bodies and joints: links on fixed joints merged
    Merged,
    /// Of bodies and joints: in the plane that the motion stays in
    Planar,
    /// Of bodies and joints: one free body, without the machinery of a tree
    SingleBody,
}

impl ModelName {
    /// The same of a robot.
    ///
    /// # Errors
    /// What robots have instead.
    pub fn of_robot(self) -> Result<ModelChoice, String> {
        match self {
            Self::Auto => Ok(ModelChoice::Auto),
            Self::Full => Ok(ModelChoice::Full),
            Self::Lumped => Ok(ModelChoice::Lumped),
            _ => Err(self.wrong("auto, full or lumped for a robot")),
        }
    }

    /// The same of bodies and joints; none for the smallest.
    ///
    /// # Errors
    /// What these have instead.
    pub fn of_mechanism(self) -> Result<Option<MechanismModel>, String> {
        match self {
            Self::Auto => Ok(None),
            Self::Full => Ok(Some(MechanismModel::Full)),
            Self::Merged => Ok(Some(MechanismModel::Merged)),
            Self::Planar => Ok(Some(MechanismModel::Planar)),
            Self::SingleBody => Ok(Some(MechanismModel::SingleBody)),
            Self::Lumped => {
                Err(self.wrong("auto, full, merged, planar or single-body for bodies and joints"))
            }
        }
    }

    fn wrong(self, expected: &str) -> String {
        let name = self.to_possible_value().map(|value| value.get_name().to_owned());
        format!("--model {}: expected {expected}", name.unwrap_or_default())
    }
}

//! How much of the robot is modelled: no more than what matters in the scene.

use super::check::wrong;
use super::{Scene, SceneError};
use crate::plant::RobotModel;
use serde::{Deserialize, Serialize};
use surefoot_mechanics::integrators::Method;

/// Which model of the robot a scene asks for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum ModelChoice {
    /// The smallest whose stated deviation the scene bears.
    #[default]
    Auto,
    /// All 13 bodies.
    Full,
    /// Seven bodies.
    Lumped,
}

/// What matters in a scene.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Matters {
    /// How far the central body may be from where the full model has it, at any time, m; 1 mm unless said,
    /// which is what the set point is held to.
    pub deviation_m: f64,
}

impl Default for Matters {
    fn default() -> Self {
        Self { deviation_m: 1e-3 }
    }
}

impl Matters {
    /// Whether nothing was said.
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }
}

impl ModelChoice {
    /// Whether nothing was said.
    pub fn is_auto(&self) -> bool {
        *self == Self::Auto
    }
}

/// The model that a scene is played with, and why.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Rung {
    /// The model.
    pub model: RobotModel,
    /// For people.
    pub reason: String,
}

/// How far the lumped model's central body strays from the full one's, m: at most 3.9e-6 m (and 6e-5 rad) in the
/// built-in scenes and both readings of the first instant, on rubber, under the bare tick, with a margin (under the
/// supervisor, whose doubts may fall on other ticks, 1.4e-5 m). A test holds them to it;
/// `surefoot chart parsimony --scene` measures it in others.
pub const LUMPED_DEVIATION_M: f64 = 1e-5;
/// Hips that start bent by more than this, degrees, are left to hinges, which know no gimbal lock at 90°.
const MOST_BENT_DEG: f64 = 70.0;

impl Scene {
    /// The model that plays this scene: the smallest that it bears, or the one that it names.
    pub fn rung(&self) -> Rung {
        let (model, reason) = match self.model {
            ModelChoice::Full => (RobotModel::Full, "the scene names it".to_owned()),
            ModelChoice::Lumped => (RobotModel::Lumped, "the scene names it".to_owned()),
            ModelChoice::Auto => match self.needs_hinges() {
                Some(need) => (RobotModel::Full, need.to_owned()),
                None if self.matters.deviation_m < LUMPED_DEVIATION_M => (
                    RobotModel::Full,
                    format!(
                        "{:.0e} m matter, and the lumped model is off by up to {LUMPED_DEVIATION_M:.0e} m in the \
                         built-in scenes",
                        self.matters.deviation_m
                    ),
                ),
                // What was measured in the built-in scenes is not claimed of others.
                None => (
                    RobotModel::Lumped,
                    format!(
                        "{:.0e} m matter; in the built-in scenes it is within {LUMPED_DEVIATION_M:.0e} m of the full \
                         model (chart parsimony measures others)",
                        self.matters.deviation_m
                    ),
                ),
            },
        };
        Rung { model, reason }
    }

    /// What only the model with all hinges can do, if the scene asks for it.
    fn needs_hinges(&self) -> Option<&'static str> {
        // What lumping does was measured of the biped.
        let Some(initial) = self.initial.legs() else {
            return Some("the robot of a file has no other");
        };
        let hips = [initial.left_leg_deg[1], initial.right_leg_deg[1]];
        if self.integrator.name != Method::Variational {
            Some("the baseline method has no other")
        } else if self.acting.joint_stops.is_some() {
            Some("joint stops need hinges")
        } else if !self.plant.is_model() {
            Some("what differs from the model needs all bodies")
        } else if self.acting.range_stiffness.is_some() {
            Some("joint stops need hinges")
        } else if hips.iter().any(|hip| !(hip.abs() <= MOST_BENT_DEG)) {
            Some("a hip starts near the gimbal lock of a spherical joint")
        } else {
            None
        }
    }
}

/// A model that can play the scene.
pub(super) fn check_model(scene: &Scene) -> Result<(), SceneError> {
    let deviation = scene.matters.deviation_m;
    if !(deviation.is_finite() && deviation >= 0.0) {
        return Err(wrong(scene, "matters.deviation_m", deviation, "a length of zero or more"));
    }
    if let (ModelChoice::Lumped, Some(need)) = (scene.model, scene.needs_hinges()) {
        return Err(wrong(scene, "model", scene.model, format!("full or auto: {need}")));
    }
    Ok(())
}

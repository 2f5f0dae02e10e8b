//! What the robot of a scene has otherwise than the controller's model of it.

use super::check::wrong;
use super::{Feet, Scene, SceneError};
use crate::plant::{BodyDifference, Differences, JointDifference};
use crate::robot::Robot;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use surefoot_mechanics::integrators::Method;

/// Bodies and joints that differ, by their names in the record.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PlantTable {
    /// By name of the body.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub bodies: BTreeMap<String, BodyTable>,
    /// By name of the joint.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub joints: BTreeMap<String, JointTable>,
    /// All joints, where their own tables say nothing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub every_joint: Option<JointTable>,
}

/// A body that differs.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct BodyTable {
    /// Times the model's mass and inertia.
    pub mass_factor: f64,
    /// Times what that makes of the inertia about the centre of mass.
    pub inertia_factor: f64,
    /// Of the centre of mass, in the body's axes, m.
    pub center_shift_m: [f64; 3],
    /// A small ball that is fixed to it, kg.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub added_mass_kg: Option<f64>,
    /// Its place, from the model's centre of mass in the body's axes, m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub added_at_m: Option<[f64; 3]>,
}

impl Default for BodyTable {
    fn default() -> Self {
        Self {
            mass_factor: 1.0,
            inertia_factor: 1.0,
            center_shift_m: [0.0; 3],
            added_mass_kg: None,
            added_at_m: None,
        }
    }
}

/// A joint that differs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct JointTable {
    /// Of its place in the inboard body, in that one's axes, m: a longer or shorter link.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shift_m: Option<[f64; 3]>,
    /// In place of the model's, kg·m².
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rotor_inertia_kg_m2: Option<f64>,
    /// In place of the robot file's, N·m·s/rad.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub damping: Option<f64>,
    /// Dry friction in place of the robot file's, N·m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction_nm: Option<f64>,
}

/// Least and greatest factor of a mass or inertia.
const FACTORS: [f64; 2] = [0.01, 100.0];
/// Farthest that a centre of mass or a joint is shifted, m.
const FARTHEST: f64 = 1.0;

impl PlantTable {
    /// Whether the robot is the model.
    pub fn is_model(&self) -> bool {
        *self == Self::default()
    }

    /// By number, of a robot that has all that is named.
    pub fn differences(&self, robot: &Robot) -> Differences {
        let number = |names: &[String], name: &String| names.iter().position(|own| own == name);
        let bodies = self.bodies.iter().filter_map(|(name, table)| {
            let added = table
                .added_mass_kg
                .map(|mass| (mass, Vector3::from(table.added_at_m.unwrap_or_default())));
            Some(BodyDifference {
                body: number(&robot.bodies, name)?,
                mass_factor: table.mass_factor,
                inertia_factor: table.inertia_factor,
                center_shift: table.center_shift_m.into(),
                added,
            })
        });
        let every = self.every_joint.unwrap_or_default();
        let joints = robot.columns.iter().enumerate().map(|(joint, name)| {
            let own = self.joints.get(name).copied().unwrap_or_default();
            JointDifference {
                joint,
                shift: own.shift_m.or(every.shift_m).unwrap_or_default().into(),
                rotor_inertia: own.rotor_inertia_kg_m2.or(every.rotor_inertia_kg_m2),
                damping: own.damping.or(every.damping),
                friction: own.friction_nm.or(every.friction_nm),
            }
        });
        let differs = |joint: &JointDifference| {
            *joint != JointDifference { joint: joint.joint, ..JointDifference::default() }
        };
        Differences { bodies: bodies.collect(), joints: joints.filter(differs).collect() }
    }
}

/// Bodies and joints that there are, with numbers that they can have.
pub(super) fn check_plant(scene: &Scene) -> Result<(), SceneError> {
    let plant = &scene.plant;
    if plant.is_model() {
        return Ok(());
    }
    let robot = scene.robot();
    for (name, table) in &plant.bodies {
        known(scene, "plant.bodies", name, &robot.bodies, "a body")?;
        body(scene, &format!("plant.bodies.{name}"), table)?;
    }
    for (name, table) in &plant.joints {
        known(scene, "plant.joints", name, &robot.columns, "a joint")?;
        joint(scene, &format!("plant.joints.{name}"), table)?;
    }
    if let Some(table) = &plant.every_joint {
        joint(scene, "plant.every_joint", table)?;
    }
    if scene.integrator.name != Method::Variational {
        let expected = format!("none, or the method {}", Method::Variational);
        return Err(wrong(scene, "plant", plant, expected));
    }
    let shifts = plant.joints.values().chain(&plant.every_joint).any(|t| t.shift_m.is_some());
    if shifts && matches!(scene.feet, Feet::Welded {}) {
        let expected = "no joint that is shifted, as the feet are held where the model has them";
        return Err(wrong(scene, "plant.joints", &plant.joints, expected));
    }
    Ok(())
}

fn known(
    scene: &Scene,
    field: &str,
    name: &str,
    all: &[String],
    what: &str,
) -> Result<(), SceneError> {
    match all.iter().any(|own| own == name) {
        true => Ok(()),
        false => Err(wrong(scene, field, name, format!("{what} of the robot: {}", all.join(", ")))),
    }
}

fn body(scene: &Scene, field: &str, table: &BodyTable) -> Result<(), SceneError> {
    let field = |what: &str| format!("{field}.{what}");
    let [least, most] = FACTORS;
    for (what, factor) in
        [("mass_factor", table.mass_factor), ("inertia_factor", table.inertia_factor)]
    {
        if !(least..=most).contains(&factor) {
            let expected = format!("a factor of {least} to {most}");
            return Err(wrong(scene, &field(what), factor, expected));
        }
    }
    near(scene, &field("center_shift_m"), &table.center_shift_m)?;
    match (table.added_mass_kg, table.added_at_m) {
        (Some(mass), _) if !(mass > 1e-6 && mass <= 1e4) => {
            let expected = "a mass of 1e-6 to 1e4 kg";
            Err(wrong(scene, &field("added_mass_kg"), mass, expected))
        }
        (Some(_), Some(at)) => near(scene, &field("added_at_m"), &at),
        (None, Some(at)) => {
            Err(wrong(scene, &field("added_at_m"), at, "none, as no mass is added"))
        }
        _ => Ok(()),
    }
}

fn joint(scene: &Scene, field: &str, table: &JointTable) -> Result<(), SceneError> {
    let field = |what: &str| format!("{field}.{what}");
    if let Some(shift) = &table.shift_m {
        near(scene, &field("shift_m"), shift)?;
    }
    for (what, value) in [
        ("rotor_inertia_kg_m2", table.rotor_inertia_kg_m2),
        ("damping", table.damping),
        ("friction_nm", table.friction_nm),
    ] {
        if let Some(value) = value
            && !(0.0..=1e5).contains(&value)
        {
            return Err(wrong(scene, &field(what), value, "a number of 0 to 1e5"));
        }
    }
    Ok(())
}

fn near(scene: &Scene, field: &str, at: &[f64; 3]) -> Result<(), SceneError> {
    match at.iter().all(|x| x.abs() <= FARTHEST) {
        true => Ok(()),
        false => {
            Err(wrong(scene, field, at, format!("lengths of at most {FARTHEST} m either way")))
        }
    }
}

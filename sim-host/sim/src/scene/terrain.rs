//! Ground that is not level, of which the controller knows nothing.

use super::check::wrong;
use super::{Feet, Scene, SceneError};
use crate::plant::PlantState;
use crate::robot::{Foot, Robot};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use surefoot_mechanics::integrators::Method;
use surefoot_multibody::contact::GroundPlane;

/// A slope through the origin, and what each foot finds under it otherwise.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Terrain {
    /// How steep it is, degrees.
    pub slope_deg: f64,
    /// Where it ascends, degrees: 0 along x, 90 along y.
    pub uphill_deg: f64,
    /// Patches under feet, by their names.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub under: BTreeMap<String, Patch>,
}

/// The ground under a foot, against the slope around it: it turns about the middle of the foot where that starts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Patch {
    /// How much higher, m.
    pub height_m: f64,
    /// How steep it is, degrees, whatever the slope around it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub slope_deg: Option<f64>,
    /// Where it ascends, degrees; as the slope unless said.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub uphill_deg: Option<f64>,
}

/// Steepest ground, degrees, and how far from z = 0 a foot's may be, m.
const STEEPEST_DEG: f64 = 60.0;
const HIGHEST: f64 = 1.0;

impl Terrain {
    /// Whether it is the plane z = 0 everywhere.
    pub fn is_level(&self) -> bool {
        self.slope_deg == 0.0 && self.under.is_empty()
    }

    /// The plane under each foot of a robot that starts in a state; nothing where all is level.
    pub fn planes(&self, robot: &Robot, start: &PlantState) -> Vec<GroundPlane> {
        if self.is_level() {
            return Vec::new();
        }
        let slope = |patch: &Patch, point| {
            let steep = patch.slope_deg.unwrap_or(self.slope_deg).to_radians();
            let uphill = patch.uphill_deg.unwrap_or(self.uphill_deg).to_radians();
            GroundPlane::new(point, steep, uphill)
        };
        let around = slope(&Patch::default(), Vector3::zeros());
        let places = robot.feet.iter().zip(robot.foot_points(start));
        let under = |(foot, points): (&Foot, Vec<Vector3<f64>>)| match self.under.get(&foot.name) {
            None => around,
            Some(patch) => {
                let middle = points.iter().sum::<Vector3<f64>>() / points.len().max(1) as f64;
                let height = around.height_at(middle.x, middle.y) + patch.height_m;
                slope(patch, Vector3::new(middle.x, middle.y, height))
            }
        };
        places.map(under).collect()
    }

    /// How much a robot has to be raised so that the lowest of its points just touches the ground, m.
    pub(super) fn raise(&self, robot: &Robot, state: &PlantState) -> f64 {
        let planes = self.planes(robot, state);
        let feet = robot.foot_points(state);
        let depths = planes
            .iter()
            .zip(&feet)
            .flat_map(|(plane, points)| points.iter().map(|p| plane.height_at(p.x, p.y) - p.z));
        let deepest = depths.fold(f64::NEG_INFINITY, f64::max);
        if deepest.is_finite() { deepest } else { 0.0 }
    }
}

/// Ground that can be stood on, under feet that there are.
pub(super) fn check_terrain(scene: &Scene) -> Result<(), SceneError> {
    let terrain = &scene.terrain;
    let steep = |field: &str, slope: f64| match slope.abs() <= STEEPEST_DEG {
        true => Ok(()),
        false => {
            let expected = format!("an angle of at most {STEEPEST_DEG}° either way");
            Err(wrong(scene, field, slope, expected))
        }
    };
    let turned = |field: &str, uphill: f64| match uphill.is_finite() {
        true => Ok(()),
        false => Err(wrong(scene, field, uphill, "a finite angle")),
    };
    steep("terrain.slope_deg", terrain.slope_deg)?;
    turned("terrain.uphill_deg", terrain.uphill_deg)?;
    let robot = scene.robot();
    for (name, patch) in &terrain.under {
        let field = |what: &str| format!("terrain.under.{name}.{what}");
        if !robot.feet.iter().any(|foot| foot.name == *name) {
            let names: Vec<&str> = robot.feet.iter().map(|foot| foot.name.as_str()).collect();
            let expected = format!("a foot of the robot: {}", names.join(", "));
            return Err(wrong(scene, "terrain.under", name, expected));
        }
        if !(patch.height_m.abs() <= HIGHEST) {
            let expected = format!("a height of at most {HIGHEST} m either way");
            return Err(wrong(scene, &field("height_m"), patch.height_m, expected));
        }
        patch.slope_deg.map_or(Ok(()), |slope| steep(&field("slope_deg"), slope))?;
        patch.uphill_deg.map_or(Ok(()), |uphill| turned(&field("uphill_deg"), uphill))?;
    }
    if terrain.is_level() {
        return match terrain.uphill_deg == 0.0 {
            true => Ok(()),
            false => {
                let expected = "none, as nothing is steep";
                Err(wrong(scene, "terrain.uphill_deg", terrain.uphill_deg, expected))
            }
        };
    }
    if matches!(scene.feet, Feet::Welded {}) {
        let expected = "none, as the feet are held where they start";
        return Err(wrong(scene, "terrain", terrain, expected));
    }
    if scene.integrator.name != Method::Variational {
        let expected = format!("none, or the method {}", Method::Variational);
        return Err(wrong(scene, "terrain", terrain, expected));
    }
    Ok(())
}

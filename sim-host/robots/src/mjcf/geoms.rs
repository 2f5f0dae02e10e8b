//! `<geom>`: collision shape, mass and inertia.

use super::compiler::{Compiler, unsupported};
use super::orientation;
use crate::description::{Shape, ShapeKind};
use crate::error::ImportError;
use crate::inertial::Inertial;
use crate::xml::Element;
use nalgebra::{Isometry3, Matrix3, Unit, Vector3};
use std::collections::HashMap;
use std::f64::consts::PI;

/// kg/m³, of geoms that state neither mass nor density.
const DENSITY: f64 = 1000.0;

/// Mesh assets: file and scale, by name.
pub(super) type Meshes = HashMap<String, (String, [f64; 3])>;

/// A geom in its body's frame.
#[derive(Debug)]
pub(super) struct Geom {
    /// `None` where its group does not count.
    pub inertial: Option<Inertial>,
    /// `None` where it collides with nothing.
    pub shape: Option<Shape>,
}

/// Reads a geom with the attributes of its class in it. Of the world's, only the place is read.
pub(super) fn read(
    geom: &Element,
    compiler: &Compiler,
    meshes: &Meshes,
    wants_inertia: bool,
) -> Result<Geom, ImportError> {
    let kind = geom.attribute("type").unwrap_or(if geom.attribute("mesh").is_some() {
        "mesh"
    } else {
        "sphere"
    });
    let mut pose = orientation::frame(geom, compiler)?;
    let mut size = geom.list("size")?.unwrap_or_default();
    if let Some([a, b, c, d, e, f]) = geom.numbers("fromto")?
        && ["capsule", "cylinder", "box", "ellipsoid"].contains(&kind)
    {
        let (from, to) = (Vector3::new(a, b, c), Vector3::new(d, e, f));
        let span = to - from;
        let along = Unit::try_new(span, 1e-12)
            .ok_or_else(|| geom.malformed("two points apart in fromto", "the same twice"))?;
        pose = Isometry3::from_parts((0.5 * (from + to)).into(), orientation::from_z(&along));
        let half = 0.5 * span.norm();
        let radius = size.first().copied().unwrap_or(0.0);
        size = if ["box", "ellipsoid"].contains(&kind) {
            vec![radius, radius, half]
        } else {
            vec![radius, half]
        };
    }
    let need = |count: usize| {
        if size.len() < count || size.iter().take(count).any(|x| !(*x > 0.0 && *x < 1e6)) {
            return Err(
                geom.malformed(format!("{count} positive numbers in size"), format!("{size:?}"))
            );
        }
        Ok(())
    };
    // Volume, moments of inertia of a unit mass, and what it is to the floor.
    let (volume, moments, shape) = match kind {
        "sphere" => {
            need(1)?;
            let (volume, moment) = (4.0 / 3.0 * PI * size[0].powi(3), 0.4 * size[0].powi(2));
            (volume, [moment; 3], ShapeKind::Sphere(size[0]))
        }
        "box" => {
            need(3)?;
            let half = [size[0], size[1], size[2]];
            (8.0 * half[0] * half[1] * half[2], crosswise(half, 1.0 / 3.0), ShapeKind::Box(half))
        }
        "ellipsoid" => {
            need(3)?;
            let axes = [size[0], size[1], size[2]];
            let volume = 4.0 / 3.0 * PI * axes[0] * axes[1] * axes[2];
            (volume, crosswise(axes, 0.2), ShapeKind::Other("an ellipsoid".into()))
        }
        "cylinder" => {
            need(2)?;
            let (r, half) = (size[0], size[1]);
            let across = (3.0 * r * r + 4.0 * half * half) / 12.0;
            let moments = [across, across, 0.5 * r * r];
            (2.0 * PI * r * r * half, moments, ShapeKind::Cylinder(r, half))
        }
        "capsule" => {
            need(2)?;
            let (volume, moments) = capsule(size[0], size[1]);
            (volume, moments, ShapeKind::Capsule(size[0], size[1]))
        }
        "mesh" => {
            let name = geom.required_attribute("mesh")?;
            let (file, scale) = meshes
                .get(name)
                .ok_or_else(|| geom.malformed("the name of a mesh asset", format!("{name:?}")))?;
            (0.0, [0.0; 3], ShapeKind::Mesh(file.clone(), *scale))
        }
        // Only the world has these, or they have no mass.
        "plane" | "hfield" => (0.0, [0.0; 3], ShapeKind::Other(format!("a {kind}"))),
        "sdf" => return Err(unsupported(geom, "a geom of type sdf", "use a simple shape")),
        other => return Err(geom.malformed("a type of geom", format!("{other:?}"))),
    };
    let group = geom.number("group")?.unwrap_or(0.0);
    let counts = (compiler.inertia_groups[0]..=compiler.inertia_groups[1]).contains(&group);
    let inertial = if wants_inertia && counts {
        Some(inertial(geom, kind, volume, moments)?.moved(&pose))
    } else {
        None
    };
    let zero = |name: &str| geom.attribute(name).is_some_and(|value| value.trim() == "0");
    let collides = !(zero("contype") && zero("conaffinity"));
    let shape = collides.then(|| Shape { place: geom.place.clone(), pose, kind: shape });
    Ok(Geom { inertial, shape })
}

fn inertial(
    geom: &Element,
    kind: &str,
    volume: f64,
    moments: [f64; 3],
) -> Result<Inertial, ImportError> {
    let mass = match geom.size("mass")? {
        Some(mass) => mass,
        None => geom.size("density")?.unwrap_or(DENSITY) * volume,
    };
    if kind == "mesh"
        && (mass > 0.0 || geom.size("density")?.unwrap_or(DENSITY) > 0.0)
        && geom.size("mass")? != Some(0.0)
    {
        let advice = "give the body an <inertial>, or the geom mass=\"0\"";
        return Err(unsupported(geom, "inertia from a mesh", advice));
    }
    if super::compiler::flag(geom, "shellinertia")? == Some(true) {
        return Err(unsupported(geom, "shellinertia", "give the body an <inertial>"));
    }
    let inertia = Matrix3::from_diagonal(&(Vector3::from(moments) * mass));
    Ok(Inertial { mass, center: Vector3::zeros(), inertia })
}

/// `factor (b² + c²)` and so on.
fn crosswise([a, b, c]: [f64; 3], factor: f64) -> [f64; 3] {
    [factor * (b * b + c * c), factor * (c * c + a * a), factor * (a * a + b * b)]
}

/// Volume, and moments of a unit mass: a cylinder with a half ball at either end. The centre of mass of a
/// half ball is 3/8 r from its plane.
fn capsule(r: f64, half: f64) -> (f64, [f64; 3]) {
    let (cylinder, ball) = (2.0 * PI * r * r * half, 4.0 / 3.0 * PI * r.powi(3));
    let volume = cylinder + ball;
    let (cylinder, ball) = (cylinder / volume, ball / volume);
    let across = cylinder * (3.0 * r * r + 4.0 * half * half) / 12.0
        + ball * (0.4 * r * r + half * half + 0.75 * half * r);
    (volume, [across, across, 0.5 * cylinder * r * r + 0.4 * ball * r * r])
}

//! URDF: <https://wiki.ros.org/urdf/XML>.
//!
//! An own reader over an XML tree, since each error names its line and what is not read is listed. Elements
//! may come in any order; a link without `<inertial>` has no mass; other namespaces are left out.

use crate::description::{
    DescribedBase, DescribedJoint, DescribedKind, DescribedLink, DescribedMimic, Description,
    JointProperties, Shape, ShapeKind,
};
use crate::error::{ImportError, Refusal};
use crate::inertial::Inertial;
use crate::xml::Element;
use nalgebra::{Isometry3, Matrix3, Translation3, UnitQuaternion, Vector3};
use std::collections::HashMap;

/// Standard gravity of the dissertation and of Pinocchio, m/s².
const GRAVITY: [f64; 3] = [0.0, 0.0, -9.81];

/// Reads the root element `<robot>`.
pub(crate) fn read(root: &Element) -> Result<Description, ImportError> {
    let name = root.attribute("name").unwrap_or("robot").to_owned();
    let mut links = Vec::new();
    let mut by_name = HashMap::new();
    for element in root.all("link") {
        let name = element.required_attribute("name")?.to_owned();
        if by_name.insert(name.clone(), links.len()).is_some() {
            return Err(element.malformed("a name of its own", "that of another link"));
        }
        links.push(link(element, name)?);
    }
    let mut joints: Vec<DescribedJoint> = Vec::new();
    let mut names = HashMap::new();
    for element in root.all("joint") {
        let joint = joint(element, &by_name)?;
        if names.insert(joint.name.clone(), ()).is_some() {
            return Err(element.malformed("a name of its own", "that of another joint"));
        }
        joints.push(joint);
    }
    if links.is_empty() {
        return Err(root.malformed("a <link>", "none"));
    }
    let unread = root.unread();
    Ok(Description {
        name,
        base: DescribedBase::Open,
        gravity: GRAVITY,
        fixed_mass: 0.0,
        links,
        joints,
        constraints: Vec::new(),
        feet: Vec::new(),
        unread,
    })
}

fn link(element: &Element, name: String) -> Result<DescribedLink, ImportError> {
    let inertial = match element.one("inertial")? {
        Some(inertial) => Some(self::inertial(inertial)?),
        None => None,
    };
    let mut shapes = Vec::new();
    for collision in element.all("collision") {
        // Its name is nobody's concern.
        collision.attribute("name");
        let geometry = collision.required("geometry")?;
        shapes.push(Shape {
            place: collision.place.clone(),
            pose: origin(collision)?,
            kind: shape(geometry)?,
        });
    }
    Ok(DescribedLink { inertial, shapes, ..DescribedLink::bare(&name, &element.place) })
}

fn inertial(element: &Element) -> Result<Inertial, ImportError> {
    let mass = element.required("mass")?;
    let value = mass.required_number("value")?;
    if value < 0.0 {
        return Err(mass.malformed("a mass of 0 or more", value.to_string()));
    }
    let inertia = element.required("inertia")?;
    let i = |name| inertia.required_number(name);
    let (xy, xz, yz) = (i("ixy")?, i("ixz")?, i("iyz")?);
    let tensor = Matrix3::new(i("ixx")?, xy, xz, xy, i("iyy")?, yz, xz, yz, i("izz")?);
    let own = Inertial { mass: value, center: Vector3::zeros(), inertia: tensor };
    Ok(own.moved(&origin(element)?))
}

/// `<origin xyz rpy>` of an element: rotations about fixed axes, roll first.
fn origin(element: &Element) -> Result<Isometry3<f64>, ImportError> {
    let Some(origin) = element.one("origin")? else { return Ok(Isometry3::identity()) };
    let [x, y, z] = origin.numbers("xyz")?.unwrap_or_default();
    let [roll, pitch, yaw] = origin.numbers("rpy")?.unwrap_or_default();
    let rotation = UnitQuaternion::from_euler_angles(roll, pitch, yaw);
    Ok(Isometry3::from_parts(Translation3::new(x, y, z), rotation))
}

fn shape(geometry: &Element) -> Result<ShapeKind, ImportError> {
    if let Some(shape) = geometry.one("box")? {
        let [x, y, z] = sizes(shape, "size")?;
        return Ok(ShapeKind::Box([0.5 * x, 0.5 * y, 0.5 * z]));
    }
    if let Some(shape) = geometry.one("sphere")? {
        return Ok(ShapeKind::Sphere(sizes::<1>(shape, "radius")?[0]));
    }
    for tag in ["cylinder", "capsule"] {
        if let Some(shape) = geometry.one(tag)? {
            let ([radius], [length]) = (sizes(shape, "radius")?, sizes(shape, "length")?);
            let kind = if tag == "cylinder" { ShapeKind::Cylinder } else { ShapeKind::Capsule };
            return Ok(kind(radius, 0.5 * length));
        }
    }
    if let Some(shape) = geometry.one("mesh")? {
        let scale = shape.numbers("scale")?.unwrap_or([1.0; 3]);
        return Ok(ShapeKind::Mesh(shape.required_attribute("filename")?.to_owned(), scale));
    }
    let found = geometry.children.first().map_or("none".into(), |child| {
        child.mark();
        child.describe()
    });
    Ok(ShapeKind::Other(found))
}

fn sizes<const N: usize>(element: &Element, name: &str) -> Result<[f64; N], ImportError> {
    element.required_attribute(name)?;
    match element.numbers::<N>(name)? {
        Some(sizes) if sizes.iter().all(|x| *x >= 0.0) => Ok(sizes),
        _ => Err(element.malformed(format!("{name} of 0 or more"), "less")),
    }
}

fn joint(element: &Element, links: &HashMap<String, usize>) -> Result<DescribedJoint, ImportError> {
    let name = element.required_attribute("name")?.to_owned();
    let kind = match element.required_attribute("type")? {
        "fixed" => DescribedKind::Fixed,
        "revolute" => DescribedKind::Revolute,
        "continuous" => DescribedKind::Continuous,
        "prismatic" => DescribedKind::Prismatic,
        "floating" => DescribedKind::Floating,
        "planar" => {
            let refusal = Refusal::Unsupported {
                what: "a planar joint".into(),
                advice: "write it as two prismatic joints and a revolute one".into(),
            };
            let subject = format!("joint {name}");
            return Err(ImportError::refused(Some(&element.place), subject, refusal));
        }
        other => {
            let expected = "type fixed, revolute, continuous, prismatic or floating".to_owned();
            return Err(element.malformed(expected, other));
        }
    };
    let end = |tag: &str| -> Result<usize, ImportError> {
        let end = element.required(tag)?;
        let link = end.required_attribute("link")?;
        links
            .get(link)
            .copied()
            .ok_or_else(|| end.malformed("the name of a link of this file", format!("{link:?}")))
    };
    let (parent, child) = (end("parent")?, end("child")?);
    Ok(DescribedJoint {
        name,
        place: element.place.clone(),
        parent,
        child,
        kind,
        origin: origin(element)?,
        axis: axis(element, kind)?,
        point: Vector3::zeros(),
        properties: properties(element, kind)?,
        mimic: mimic(element)?,
    })
}

fn axis(element: &Element, kind: DescribedKind) -> Result<Vector3<f64>, ImportError> {
    let Some(axis) = element.one("axis")? else { return Ok(Vector3::x()) };
    let xyz = Vector3::from(axis.numbers("xyz")?.unwrap_or([1.0, 0.0, 0.0]));
    let norm = xyz.norm();
    let needed = !matches!(kind, DescribedKind::Fixed | DescribedKind::Floating);
    // An axis along a coordinate axis keeps its digits.
    if (norm - 1.0).abs() < 1e-15 || !needed {
        return Ok(xyz);
    }
    if norm < 1e-6 {
        return Err(axis.malformed("an axis with a length", format!("{norm:e}")));
    }
    Ok(xyz / norm)
}

fn properties(element: &Element, kind: DescribedKind) -> Result<JointProperties, ImportError> {
    let mut properties = JointProperties::default();
    if let Some(dynamics) = element.one("dynamics")? {
        properties.damping = dynamics.size("damping")?.unwrap_or(0.0);
        properties.friction = dynamics.size("friction")?.unwrap_or(0.0);
    }
    if let Some(limit) = element.one("limit")? {
        let bound = |name| Ok::<_, ImportError>(limit.list(name)?.and_then(|x| x.first().copied()));
        let (lower, upper) = (bound("lower")?, bound("upper")?);
        // One that is left out is 0; a joint without either has no end stops.
        let range = lower.or(upper).map(|_| [lower.unwrap_or(0.0), upper.unwrap_or(0.0)]);
        let [lower, upper] = range.unwrap_or_default();
        if lower > upper {
            return Err(limit.malformed("lower ≤ upper", format!("{lower} > {upper}")));
        }
        let ends = matches!(kind, DescribedKind::Revolute | DescribedKind::Prismatic);
        properties.range = range.filter(|_| ends);
        // Files state 0 where nobody has measured.
        properties.effort = bound("effort")?.filter(|x| *x > 0.0);
        properties.rate = bound("velocity")?.filter(|x| *x > 0.0);
    }
    Ok(properties)
}

fn mimic(element: &Element) -> Result<Option<DescribedMimic>, ImportError> {
    let Some(mimic) = element.one("mimic")? else { return Ok(None) };
    Ok(Some(DescribedMimic {
        leader: mimic.required_attribute("joint")?.to_owned(),
        multiplier: mimic.number("multiplier")?.unwrap_or(1.0),
        offset: mimic.number("offset")?.unwrap_or(0.0),
    }))
}

//! `<body>`: links, and a chain of massless ones where a body has several joints.

use super::compiler::{Compiler, InertiaFromGeoms, flag, unsupported};
use super::defaults::Defaults;
use super::geoms::{self, Meshes};
use super::orientation;
use crate::description::{DescribedJoint, DescribedKind, DescribedLink, JointProperties};
use crate::error::{ImportError, Place};
use crate::inertial::Inertial;
use crate::robot::{RobotMotion, displacement};
use crate::xml::Element;
use nalgebra::{Isometry3, Matrix3, Vector3};
use std::collections::HashMap;

/// The world's link.
const WORLD: &str = "world";

/// What the world's tree holds.
#[derive(Debug, Default)]
pub(super) struct Found {
    pub links: Vec<DescribedLink>,
    pub joints: Vec<DescribedJoint>,
    pub constraints: Vec<(Place, String)>,
    /// Bodies so far, counted as MuJoCo does.
    bodies: usize,
    /// Of joints, by name.
    pub names: HashMap<String, usize>,
    link_names: HashMap<String, usize>,
}

struct Reader<'a> {
    compiler: &'a Compiler,
    defaults: &'a Defaults,
    meshes: Meshes,
    found: Found,
}

/// What a body is read into.
#[derive(Clone, Copy)]
struct Into<'a> {
    /// The link.
    link: usize,
    /// Where `<frame>` has put the children, in the link's frame.
    frame: Isometry3<f64>,
    class: Option<&'a str>,
}

/// All bodies of all `<worldbody>`; the world is link 0.
pub(super) fn read(
    root: &Element,
    compiler: &Compiler,
    defaults: &Defaults,
) -> Result<Found, ImportError> {
    let meshes = meshes(root, compiler, defaults)?;
    let mut reader = Reader { compiler, defaults, meshes, found: Found::default() };
    reader.link(WORLD, &root.place)?;
    let world = Into { link: 0, frame: Isometry3::identity(), class: None };
    for body in root.all("worldbody") {
        reader.contents(body, world, &mut Vec::new(), false)?;
    }
    Ok(reader.found)
}

fn meshes(root: &Element, compiler: &Compiler, defaults: &Defaults) -> Result<Meshes, ImportError> {
    let mut meshes = Meshes::new();
    for mesh in root.all("asset").flat_map(|asset| asset.all("mesh")) {
        let mesh = defaults.apply(mesh, None)?;
        let Some(file) = mesh.attribute("file") else { continue };
        let stem = std::path::Path::new(file).file_stem().unwrap_or_default().to_string_lossy();
        let name = mesh.attribute("name").unwrap_or(&stem).to_owned();
        let path = std::path::Path::new(&compiler.mesh_folder).join(file);
        let scale = mesh.numbers("scale")?.unwrap_or([1.0; 3]);
        meshes.insert(name, (path.display().to_string(), scale));
    }
    Ok(meshes)
}

impl<'a> Reader<'a> {
    fn link(&mut self, name: &str, place: &Place) -> Result<usize, ImportError> {
        let index = self.found.links.len();
        if self.found.link_names.insert(name.to_owned(), index).is_some() {
            return Err(ImportError::Malformed {
                place: place.clone(),
                element: format!("body {name}"),
                expected: "a name of its own".into(),
                found: "that of another body".into(),
            });
        }
        self.found.links.push(DescribedLink::bare(name, place));
        Ok(index)
    }

    /// Geoms and bodies inside a body or a `<frame>`.
    fn contents(
        &mut self,
        element: &'a Element,
        into: Into<'a>,
        inertias: &mut Vec<Inertial>,
        wants_inertia: bool,
    ) -> Result<(), ImportError> {
        for child in &element.children {
            match child.tag.as_str() {
                "geom" => {
                    let geom = self.defaults.apply(child, into.class)?;
                    let geom = geoms::read(&geom, self.compiler, &self.meshes, wants_inertia)?;
                    inertias.extend(geom.inertial.map(|inertial| inertial.moved(&into.frame)));
                    if let Some(mut shape) = geom.shape {
                        shape.pose = into.frame * shape.pose;
                        self.found.links[into.link].shapes.push(shape);
                    }
                }
                "frame" => {
                    child.mark();
                    let frame = into.frame * orientation::frame(child, self.compiler)?;
                    let class = child.attribute("childclass").or(into.class);
                    let inside = Into { frame, class, ..into };
                    self.contents(child, inside, inertias, wants_inertia)?;
                }
                "body" => self.body(child, into)?,
                _ => {}
            }
        }
        Ok(())
    }

    fn body(&mut self, element: &'a Element, inside: Into<'a>) -> Result<(), ImportError> {
        element.mark();
        self.found.bodies += 1;
        let class = element.attribute("childclass").or(inside.class);
        let name = match element.attribute("name") {
            Some(name) => name.to_owned(),
            None => format!("body_{}", self.found.bodies),
        };
        let origin = inside.frame * orientation::frame(element, self.compiler)?;
        let joints: Vec<Element> = element
            .children
            .iter()
            .filter(|child| child.tag == "joint" || child.tag == "freejoint")
            .map(|joint| self.defaults.apply(joint, class))
            .collect::<Result<_, _>>()?;
        let link = self.chain(element, &name, inside.link, origin, &joints)?;
        let explicit = element.one("inertial")?;
        let from_geoms = match self.compiler.inertia_from_geoms {
            InertiaFromGeoms::Always => true,
            InertiaFromGeoms::Never => false,
            InertiaFromGeoms::Auto => explicit.is_none(),
        };
        let mut inertias = Vec::new();
        let into = Into { link, frame: Isometry3::identity(), class };
        self.contents(element, into, &mut inertias, from_geoms)?;
        self.found.links[link].inertial = match explicit {
            Some(explicit) if !from_geoms => Some(inertial(explicit, self.compiler)?),
            _ => (!inertias.is_empty()).then(|| Inertial::sum(&inertias)),
        };
        Ok(())
    }

    /// The links and joints of one body: each joint but the last carries a massless link.
    ///
    /// # Returns
    /// The body's own link.
    fn chain(
        &mut self,
        body: &Element,
        name: &str,
        parent: usize,
        origin: Isometry3<f64>,
        joints: &[Element],
    ) -> Result<usize, ImportError> {
        if joints.is_empty() {
            let child = self.link(name, &body.place)?;
            let name = format!("{name}_fixed");
            let joint = DescribedJoint::fixed(name, &body.place, [parent, child], origin);
            self.found.joints.push(joint);
            return Ok(child);
        }
        let mut at = (parent, origin);
        for (i, element) in joints.iter().enumerate() {
            let joint_name = match element.attribute("name") {
                Some(own) => own.to_owned(),
                None => format!("{name}_joint_{i}"),
            };
            let link_name = if i + 1 == joints.len() {
                name.to_owned()
            } else {
                format!("{name}/{joint_name}")
            };
            let (parent, origin) = at;
            let child = self.link(&link_name, &body.place)?;
            let joint = joint(element, joint_name.clone(), [parent, child], origin, self.compiler)?;
            if joint.kind == DescribedKind::Floating && parent != 0 {
                let expected = "a free joint only on a body of the world";
                return Err(element.malformed(expected, format!("one on body {name}")));
            }
            if self.found.names.insert(joint_name, self.found.joints.len()).is_some() {
                return Err(element.malformed("a name of its own", "that of another joint"));
            }
            self.found.joints.push(joint);
            at = (child, Isometry3::identity());
        }
        Ok(at.0)
    }
}

fn inertial(element: &Element, compiler: &Compiler) -> Result<Inertial, ImportError> {
    let mass = element.required_number("mass")?;
    if mass < 0.0 {
        return Err(element.malformed("a mass of 0 or more", mass.to_string()));
    }
    let inertia = match (element.numbers("fullinertia")?, element.numbers::<3>("diaginertia")?) {
        (Some([xx, yy, zz, xy, xz, yz]), _) => Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz),
        (None, Some(diagonal)) => Matrix3::from_diagonal(&diagonal.into()),
        (None, None) => return Err(element.malformed("diaginertia or fullinertia", "neither")),
    };
    let own = Inertial { mass, center: Vector3::zeros(), inertia };
    Ok(own.moved(&orientation::frame(element, compiler)?))
}

fn joint(
    element: &Element,
    name: String,
    [parent, child]: [usize; 2],
    origin: Isometry3<f64>,
    compiler: &Compiler,
) -> Result<DescribedJoint, ImportError> {
    let is_free = element.tag == "freejoint";
    let kind = match element.attribute("type") {
        _ if is_free => DescribedKind::Floating,
        None | Some("hinge") => DescribedKind::Revolute,
        Some("slide") => DescribedKind::Prismatic,
        Some("ball") => DescribedKind::Spherical,
        Some("free") => DescribedKind::Floating,
        Some(other) => {
            return Err(element.malformed("type hinge, slide, ball or free", format!("{other:?}")));
        }
    };
    if element.attribute("align") == Some("true") {
        return Err(unsupported(element, "align", "leave it out: the frame is the body's"));
    }
    let has_axis = matches!(kind, DescribedKind::Revolute | DescribedKind::Prismatic);
    let axis = Vector3::from(element.numbers("axis")?.unwrap_or([0.0, 0.0, 1.0]));
    if has_axis && axis.norm() < 1e-10 {
        return Err(element.malformed("an axis with a length", "none"));
    }
    let point = match kind {
        DescribedKind::Floating => Vector3::zeros(),
        _ => Vector3::from(element.numbers("pos")?.unwrap_or_default()),
    };
    let turns = kind == DescribedKind::Revolute;
    let angle = |x: f64| if turns { compiler.angle(x) } else { x };
    let mut joint = DescribedJoint {
        name,
        place: element.place.clone(),
        parent,
        child,
        kind,
        origin,
        axis: if axis.norm_squared() == 1.0 { axis } else { axis.normalize() },
        point,
        properties: properties(element, compiler, has_axis, &angle)?,
        mimic: None,
    };
    if has_axis {
        // Coordinate `ref` is where the file has the body; ours is 0 there.
        let reference = angle(element.number("ref")?.unwrap_or(0.0));
        let motion = if turns { RobotMotion::Revolute } else { RobotMotion::Prismatic };
        if reference != 0.0 {
            joint.origin *= displacement(motion, &joint.axis, &joint.point, -reference);
        }
        if turns && joint.properties.range.is_none() {
            joint.kind = DescribedKind::Continuous;
        }
    }
    Ok(joint)
}

fn properties(
    element: &Element,
    compiler: &Compiler,
    has_axis: bool,
    angle: &impl Fn(f64) -> f64,
) -> Result<JointProperties, ImportError> {
    let mut properties = JointProperties {
        armature: element.size("armature")?.unwrap_or(0.0),
        damping: element.list("damping")?.and_then(|d| d.first().copied()).unwrap_or(0.0),
        friction: element.size("frictionloss")?.unwrap_or(0.0),
        ..JointProperties::default()
    };
    if properties.armature > 0.0 && !has_axis {
        let advice = "rotors turn about an axis; set armature=\"0\" on this joint";
        return Err(unsupported(element, "armature of a ball or free joint", advice));
    }
    let limits = |name: &str, limited: &str| -> Result<Option<[f64; 2]>, ImportError> {
        let range = element.numbers::<2>(name)?;
        let is_limited = match element.attribute(limited) {
            None | Some("auto") => compiler.auto_limits && range.is_some_and(|[a, b]| a != b),
            Some(_) => flag(element, limited)? == Some(true),
        };
        match range {
            Some([lower, upper]) if is_limited && lower > upper => {
                Err(element.malformed(format!("{name} in order"), format!("{lower} > {upper}")))
            }
            range => Ok(range.filter(|_| is_limited)),
        }
    };
    if has_axis {
        properties.range = limits("range", "limited")?.map(|range| range.map(angle));
        let effort = limits("actuatorfrcrange", "actuatorfrclimited")?;
        properties.effort = effort.map(|[lower, upper]| lower.abs().max(upper.abs()));
    }
    Ok(properties)
}

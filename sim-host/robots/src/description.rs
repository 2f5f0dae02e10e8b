//! What a robot file says, before anything is lumped, locked or left out: the common result of the readers.

use crate::error::Place;
use crate::inertial::Inertial;
use nalgebra::{Isometry3, Vector3};
use std::collections::BTreeMap;

/// A robot file's content.
#[derive(Clone, Debug)]
pub(crate) struct Description {
    pub name: String,
    /// Whether the file says what the root link is; URDF does not.
    pub base: DescribedBase,
    /// m/s², world.
    pub gravity: [f64; 3],
    /// Of what the file has no link for, fixed to the world, kg.
    pub fixed_mass: f64,
    pub links: Vec<DescribedLink>,
    pub joints: Vec<DescribedJoint>,
    /// Constraints that are no joints: loops, tied tendons.
    pub constraints: Vec<(Place, String)>,
    /// Feet, where the file has them.
    pub feet: Vec<DescribedFoot>,
    /// What the reader has not read: element or attribute, and how often.
    pub unread: BTreeMap<String, usize>,
}

/// What carries the root link.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum DescribedBase {
    /// The file does not say.
    Open,
    /// The root link is the world.
    World,
}

/// A body as the file has it.
#[derive(Clone, Debug)]
pub(crate) struct DescribedLink {
    pub name: String,
    pub place: Place,
    /// In the link's frame; none where the file has none.
    pub inertial: Option<Inertial>,
    /// What it collides with.
    pub shapes: Vec<Shape>,
    /// Whether something hung from it that the file no longer has.
    pub is_inner: bool,
}

impl DescribedLink {
    /// A link without mass and shape.
    pub fn bare(name: &str, place: &Place) -> Self {
        let (name, place) = (name.to_owned(), place.clone());
        Self { name, place, inertial: None, shapes: Vec::new(), is_inner: false }
    }
}

/// A foot as the file has it.
#[derive(Clone, Debug)]
pub(crate) struct DescribedFoot {
    pub name: String,
    /// Index of its link, in whose frame the points are.
    pub link: usize,
    pub points: Vec<Vector3<f64>>,
}

/// A joint as the file has it.
#[derive(Clone, Debug)]
pub(crate) struct DescribedJoint {
    pub name: String,
    pub place: Place,
    /// Indices of links.
    pub parent: usize,
    pub child: usize,
    pub kind: DescribedKind,
    /// The child's frame in the parent's, at coordinate 0.
    pub origin: Isometry3<f64>,
    /// Of unit length, in the child's frame.
    pub axis: Vector3<f64>,
    /// Where the axis is, in the child's frame.
    pub point: Vector3<f64>,
    pub properties: JointProperties,
    pub mimic: Option<DescribedMimic>,
}

impl DescribedJoint {
    /// A joint that does not move.
    pub fn fixed(name: String, place: &Place, ends: [usize; 2], origin: Isometry3<f64>) -> Self {
        Self {
            name,
            place: place.clone(),
            parent: ends[0],
            child: ends[1],
            kind: DescribedKind::Fixed,
            origin,
            axis: Vector3::x(),
            point: Vector3::zeros(),
            properties: JointProperties::default(),
            mimic: None,
        }
    }
}

/// How a joint of a file moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum DescribedKind {
    Fixed,
    Revolute,
    /// Revolute without end stops; its coordinate counts turns as a point on the circle.
    Continuous,
    Prismatic,
    Spherical,
    Floating,
}

/// q = multiplier · q(leader) + offset
#[derive(Clone, Debug)]
pub(crate) struct DescribedMimic {
    pub leader: String,
    pub multiplier: f64,
    pub offset: f64,
}

/// What a joint has beside its motion. Angles in rad, or m for a prismatic joint.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointProperties {
    /// Inertia of the rotor seen at the joint, kg m² (kg for a prismatic joint).
    pub armature: f64,
    /// N m s/rad
    pub damping: f64,
    /// Coulomb friction, N m.
    pub friction: f64,
    /// End stops.
    pub range: Option<[f64; 2]>,
    /// rad/s
    pub rate: Option<f64>,
    /// N m
    pub effort: Option<f64>,
}

/// A collision shape in its link's frame.
#[derive(Clone, Debug)]
pub(crate) struct Shape {
    pub place: Place,
    pub pose: Isometry3<f64>,
    pub kind: ShapeKind,
}

/// Lengths in m.
#[derive(Clone, Debug)]
pub(crate) enum ShapeKind {
    /// Half sizes.
    Box([f64; 3]),
    Sphere(f64),
    /// Radius and half length along z.
    Cylinder(f64, f64),
    /// Radius and half length of the cylinder along z.
    Capsule(f64, f64),
    /// A file, and its scale.
    Mesh(String, [f64; 3]),
    /// Has no corner that could stand: said by name.
    Other(String),
}

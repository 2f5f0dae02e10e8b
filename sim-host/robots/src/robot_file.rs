//! `robot.toml`: a robot to read and edit. What is written is read back to the same robot, to the last bit.

use crate::description::{
    DescribedBase, DescribedFoot, DescribedJoint, DescribedKind, DescribedLink, DescribedMimic,
    Description, JointProperties,
};
use crate::error::{ImportError, Place};
use crate::inertial::Inertial;
use crate::robot::{Robot, RobotLink, RobotMotion};
use crate::tree::components;
use nalgebra::{Isometry3, Matrix3, Quaternion, Translation3, UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, HashMap, HashSet};
use std::path::Path;
use toml::Spanned;

/// What stands above the data.
const HEADING: &str = "\
# A robot, written by `surefoot import`. Lengths in m, angles in rad, masses in kg, times in s.
# links: each with the joint that carries it, inboard ones first; without `parent` the world carries it.
#   center_m, inertia_kg_m2 (about the centre of mass: xx, yy, zz, yz, zx, xy), axis and point_m: in the
#   link's frame. position_m, orientation (quaternion w, x, y, z): that frame in the parent's, joint at 0.
# frames: what is fixed to a link (or the world), at a pose in its frame.
# feet: points that touch the floor, in the frame of the moving link.

";

/// Numbers this near to a unit norm are taken as they are, others are scaled, up to `NORM_SLACK`.
const EXACT: f64 = 1e-14;
const NORM_SLACK: f64 = 1e-3;

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct RobotTable {
    name: String,
    gravity_m_s2: [f64; 3],
    /// Of what is fixed to the world.
    #[serde(default, skip_serializing_if = "is_default")]
    fixed_mass_kg: f64,
    #[serde(default)]
    links: Vec<LinkTable>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    frames: Vec<FrameTable>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    feet: Vec<FootTable>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct LinkTable {
    name: Spanned<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    parent: Option<String>,
    mass_kg: f64,
    #[serde(default, skip_serializing_if = "is_default")]
    center_m: [f64; 3],
    #[serde(default, skip_serializing_if = "is_default")]
    inertia_kg_m2: [f64; 6],
    joint: JointTable,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct JointTable {
    name: String,
    kind: Kind,
    #[serde(default, skip_serializing_if = "is_default")]
    position_m: [f64; 3],
    #[serde(default = "upright", skip_serializing_if = "is_upright")]
    orientation: [f64; 4],
    #[serde(skip_serializing_if = "Option::is_none")]
    axis: Option<[f64; 3]>,
    #[serde(default, skip_serializing_if = "is_default")]
    point_m: [f64; 3],
    #[serde(skip_serializing_if = "Option::is_none")]
    range: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    rate: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    effort: Option<f64>,
    #[serde(default, skip_serializing_if = "is_default")]
    armature: f64,
    #[serde(default, skip_serializing_if = "is_default")]
    damping: f64,
    #[serde(default, skip_serializing_if = "is_default")]
    friction: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    follows: Option<FollowsTable>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct FollowsTable {
    joint: String,
    multiplier: f64,
    offset: f64,
}

#[derive(Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Kind {
    Revolute,
    Continuous,
    Prismatic,
    Spherical,
    Floating,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct FrameTable {
    name: Spanned<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    link: Option<String>,
    #[serde(default, skip_serializing_if = "is_default")]
    position_m: [f64; 3],
    #[serde(default = "upright", skip_serializing_if = "is_upright")]
    orientation: [f64; 4],
    /// Whether nothing hung from it in the file that it comes from.
    #[serde(default)]
    leaf: bool,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct FootTable {
    name: Spanned<String>,
    link: String,
    points_m: Vec<[f64; 3]>,
}

fn is_default<T: Default + PartialEq>(x: &T) -> bool {
    *x == T::default()
}

fn upright() -> [f64; 4] {
    [1.0, 0.0, 0.0, 0.0]
}

fn is_upright(q: &[f64; 4]) -> bool {
    *q == upright()
}

/// The text of a robot's file.
pub fn robot_toml(robot: &Robot) -> String {
    let name = |k: usize| robot.links[k].name.clone();
    let pose = |pose: &Isometry3<f64>| {
        let q = pose.rotation;
        (components(&pose.translation.vector), [q.w, q.i, q.j, q.k])
    };
    let link = |link: &RobotLink| {
        let joint = &link.joint;
        let (position_m, orientation) = pose(&joint.origin);
        let i = &link.inertial.inertia;
        let properties = joint.properties;
        LinkTable {
            name: unplaced(&link.name),
            parent: link.parent.map(name),
            mass_kg: link.inertial.mass,
            center_m: components(&link.inertial.center),
            inertia_kg_m2: [i.m11, i.m22, i.m33, i.m23, i.m13, i.m12],
            joint: JointTable {
                name: joint.name.clone(),
                kind: kind(joint.motion),
                position_m,
                orientation,
                axis: joint.motion.has_axis().then(|| components(&joint.axis)),
                point_m: components(&joint.point),
                range: properties.range,
                rate: properties.rate,
                effort: properties.effort,
                armature: properties.armature,
                damping: properties.damping,
                friction: properties.friction,
                follows: joint.follows.map(|coupling| FollowsTable {
                    joint: robot.links[coupling.leader].joint.name.clone(),
                    multiplier: coupling.multiplier,
                    offset: coupling.offset,
                }),
            },
        }
    };
    let table = RobotTable {
        name: robot.name.clone(),
        gravity_m_s2: robot.gravity,
        fixed_mass_kg: robot.fixed_mass,
        links: robot.links.iter().map(link).collect(),
        frames: robot
            .frames
            .iter()
            .map(|frame| {
                let (position_m, orientation) = pose(&frame.pose);
                let (name, link) = (unplaced(&frame.name), frame.link.map(name));
                FrameTable { name, link, position_m, orientation, leaf: frame.is_leaf }
            })
            .collect(),
        feet: robot
            .feet
            .iter()
            .map(|foot| FootTable {
                name: unplaced(&foot.name),
                link: name(foot.link),
                points_m: foot.points.iter().map(components).collect(),
            })
            .collect(),
    };
    // Tables of strings and numbers can all be written.
    let body = toml::to_string(&table).unwrap_or_else(|error| format!("# {error}\n"));
    format!("{HEADING}{body}")
}

/// A name that is written, and so has no place yet.
fn unplaced(name: &str) -> Spanned<String> {
    Spanned::new(0..0, name.to_owned())
}

fn kind(motion: RobotMotion) -> Kind {
    match motion {
        RobotMotion::Revolute => Kind::Revolute,
        RobotMotion::Continuous => Kind::Continuous,
        RobotMotion::Prismatic => Kind::Prismatic,
        RobotMotion::Spherical => Kind::Spherical,
        RobotMotion::Floating => Kind::Floating,
    }
}

/// Reads a robot's file as a description, so that joints of it can be locked as those of other formats.
pub(crate) fn read(path: &Path) -> Result<Description, ImportError> {
    let file = path.display().to_string();
    let text = crate::xml::read_text(path)?;
    let refuse = |message: String| ImportError::Toml { file: file.clone(), message };
    let table: RobotTable = toml::from_str(&text).map_err(|error| refuse(error.to_string()))?;
    let place = |name: &Spanned<String>| {
        let before = text.get(..name.span().start).unwrap_or_default();
        let line = 1 + before.bytes().filter(|byte| *byte == b'\n').count() as u32;
        Place { file: file.as_str().into(), line }
    };
    let refuse_at = |name: &Spanned<String>, message: String| ImportError::Toml {
        file: place(name).to_string(),
        message,
    };
    let world = Place { file: file.as_str().into(), line: 1 };
    let mut reader = Reader {
        names: HashMap::new(),
        joint_names: HashSet::new(),
        links: vec![DescribedLink::bare("world", &world)],
        joints: Vec::new(),
    };
    for link in &table.links {
        reader.link(link, place(&link.name)).map_err(|e| refuse_at(&link.name, e))?;
    }
    for frame in &table.frames {
        reader.frame(frame, place(&frame.name)).map_err(|e| refuse_at(&frame.name, e))?;
    }
    let mut feet = Vec::new();
    for foot in table.feet {
        let link = reader.find(Some(&foot.link)).map_err(|e| refuse_at(&foot.name, e))?;
        if !foot.points_m.as_flattened().iter().all(|x| x.is_finite()) {
            return Err(refuse_at(&foot.name, "expected finite points_m".into()));
        }
        let points = foot.points_m.into_iter().map(Vector3::from).collect();
        feet.push(DescribedFoot { name: foot.name.into_inner(), link, points });
    }
    let sound = table.gravity_m_s2.iter().all(|x| x.is_finite()) && table.fixed_mass_kg.is_finite();
    if !sound {
        return Err(refuse("expected finite numbers in gravity_m_s2 and fixed_mass_kg".into()));
    }
    Ok(Description {
        name: table.name,
        base: DescribedBase::World,
        gravity: table.gravity_m_s2,
        fixed_mass: table.fixed_mass_kg,
        links: reader.links,
        joints: reader.joints,
        constraints: Vec::new(),
        feet,
        unread: BTreeMap::new(),
    })
}

struct Reader {
    names: HashMap<String, usize>,
    joint_names: HashSet<String>,
    links: Vec<DescribedLink>,
    joints: Vec<DescribedJoint>,
}

impl Reader {
    /// The index of a link; of the world without a name.
    fn find(&self, name: Option<&str>) -> Result<usize, String> {
        let Some(name) = name else { return Ok(0) };
        self.names.get(name).copied().ok_or_else(|| {
            let near = crate::nearest(name, self.names.keys().map(String::as_str));
            format!("no link {name:?} stands before this one names it{near}")
        })
    }

    fn add(&mut self, link: DescribedLink) -> Result<usize, String> {
        let index = self.links.len();
        if self.names.insert(link.name.clone(), index).is_some() {
            return Err(format!("two links or frames have the name {:?}", link.name));
        }
        self.links.push(link);
        Ok(index)
    }

    fn link(&mut self, table: &LinkTable, place: Place) -> Result<(), String> {
        let (name, joint) = (table.name.get_ref(), &table.joint);
        let parent = self.find(table.parent.as_deref()).map_err(|e| format!("link {name}: {e}"))?;
        let numbers = [&table.center_m[..], &table.inertia_kg_m2, &[table.mass_kg]].concat();
        if !(numbers.iter().all(|x| x.is_finite()) && table.mass_kg >= 0.0) {
            return Err(format!("link {name}: expected finite numbers, and a mass of 0 or more"));
        }
        let [xx, yy, zz, yz, zx, xy] = table.inertia_kg_m2;
        let inertial = Inertial {
            mass: table.mass_kg,
            center: table.center_m.into(),
            inertia: Matrix3::new(xx, xy, zx, xy, yy, yz, zx, yz, zz),
        };
        let mut link = DescribedLink::bare(name, &place);
        link.inertial = Some(inertial);
        let child = self.add(link)?;
        let wrong = |what: String| format!("joint {}: {what}", joint.name);
        if !self.joint_names.insert(joint.name.clone()) {
            return Err(wrong("another joint has this name".into()));
        }
        let properties = JointProperties {
            armature: joint.armature,
            damping: joint.damping,
            friction: joint.friction,
            range: joint.range,
            rate: joint.rate,
            effort: joint.effort,
        };
        let sizes = [joint.armature, joint.damping, joint.friction];
        if sizes.iter().any(|x| !(x.is_finite() && *x >= 0.0)) {
            return Err(wrong("expected armature, damping and friction of 0 or more".into()));
        }
        if joint.range.is_some_and(|[lower, upper]| !(lower <= upper)) {
            return Err(wrong("expected a range from low to high".into()));
        }
        if joint.point_m.iter().any(|x| !x.is_finite()) {
            return Err(wrong("expected a finite point_m".into()));
        }
        let axis = match joint.axis {
            Some(axis) => {
                unit(&axis).ok_or_else(|| wrong(format!("expected a unit axis, found {axis:?}")))?
            }
            None if matches!(joint.kind, Kind::Spherical | Kind::Floating) => [0.0; 3],
            None => return Err(wrong("expected an axis".into())),
        };
        self.joints.push(DescribedJoint {
            name: joint.name.clone(),
            place,
            parent,
            child,
            kind: match joint.kind {
                Kind::Revolute => DescribedKind::Revolute,
                Kind::Continuous => DescribedKind::Continuous,
                Kind::Prismatic => DescribedKind::Prismatic,
                Kind::Spherical => DescribedKind::Spherical,
                Kind::Floating => DescribedKind::Floating,
            },
            origin: pose(&joint.position_m, &joint.orientation).map_err(wrong)?,
            axis: axis.into(),
            point: joint.point_m.into(),
            properties,
            mimic: joint.follows.as_ref().map(|follows| DescribedMimic {
                leader: follows.joint.clone(),
                multiplier: follows.multiplier,
                offset: follows.offset,
            }),
        });
        Ok(())
    }

    fn frame(&mut self, table: &FrameTable, place: Place) -> Result<(), String> {
        let wrong = |what: String| format!("frame {}: {what}", table.name.get_ref());
        let parent = self.find(table.link.as_deref()).map_err(wrong)?;
        let mut link = DescribedLink::bare(table.name.get_ref(), &place);
        link.is_inner = !table.leaf;
        let child = self.add(link)?;
        let origin = pose(&table.position_m, &table.orientation).map_err(wrong)?;
        let name = format!("{}_fixed", table.name.get_ref());
        self.joints.push(DescribedJoint::fixed(name, &place, [parent, child], origin));
        Ok(())
    }
}

fn pose(position: &[f64; 3], orientation: &[f64; 4]) -> Result<Isometry3<f64>, String> {
    let [w, x, y, z] = unit(orientation)
        .ok_or_else(|| format!("expected a unit quaternion, found {orientation:?}"))?;
    if !position.iter().all(|x| x.is_finite()) {
        return Err(format!("expected a finite position_m, found {position:?}"));
    }
    let rotation = UnitQuaternion::new_unchecked(Quaternion::new(w, x, y, z));
    Ok(Isometry3::from_parts(Translation3::from(Vector3::from(*position)), rotation))
}

/// The numbers with unit norm, if they are near it; unchanged if they have it.
fn unit<const N: usize>(numbers: &[f64; N]) -> Option<[f64; N]> {
    let norm = numbers.iter().map(|x| x * x).sum::<f64>().sqrt();
    if (norm - 1.0).abs() < EXACT {
        Some(*numbers)
    } else if (norm - 1.0).abs() < NORM_SLACK {
        Some(numbers.map(|x| x / norm))
    } else {
        None
    }
}

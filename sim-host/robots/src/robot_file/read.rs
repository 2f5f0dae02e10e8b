//! From a `robot.toml` to a description, so that joints of it can be locked as those of other formats.

use super::tables::{FrameTable, Kind, LinkTable, RobotTable};
use crate::description::{
    DescribedBase, DescribedFoot, DescribedJoint, DescribedKind, DescribedLink, DescribedMimic,
    Description, JointProperties,
};
use crate::error::{ImportError, Place};
use crate::inertial::Inertial;
use nalgebra::{Isometry3, Matrix3, Quaternion, Translation3, UnitQuaternion, Vector3};
use std::collections::{BTreeMap, HashMap, HashSet};
use std::path::Path;
use toml::Spanned;

/// Numbers this near to a unit norm are taken as they are, others are scaled, up to `NORM_SLACK`.
const EXACT: f64 = 1e-14;
const NORM_SLACK: f64 = 1e-3;

/// Reads a robot's file.
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

//! `robot.toml`: a robot to read and edit. What is written is read back to the same robot, to the last bit.

mod read;
mod tables;

pub(crate) use read::read;

use crate::robot::{Robot, RobotLink, RobotMotion};
use crate::tree::components;
use nalgebra::Isometry3;
use tables::{FollowsTable, FootTable, FrameTable, JointTable, Kind, LinkTable, RobotTable};
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

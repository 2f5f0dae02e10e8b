//! A robot of a file as scenes take it: its tree, names, feet, limits, and what it looks like.

use super::{
    Foot, FootPoint, LEG, Limits, MOST_LEGS, Passive, Robot, SizedTree, stance, with_tree,
};
use crate::picture::Solid;
use nalgebra::{Matrix3, Vector3};
use surefoot::model::TreeFault;
use surefoot_robots::{JointProperties, Robot as FileRobot, RobotLink, core_links, legs};

/// Part of the height of the central body at the start, upright on its feet, below which it has fallen. The biped's
/// is the same.
const FALLEN: f64 = 0.5;
/// Thickness of a link that is drawn, in parts of its length.
const THICKNESS: f64 = 0.22;
/// The same at least, in edges of a cube of water of its mass; kg/m³.
const LEAST_THICKNESS: f64 = 0.4;
const WATER: f64 = 1e3;

/// Why a robot of a file cannot be in a scene.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NoLeggedRobot {
    /// It has other joints than those of its legs, or none.
    #[error(
        "a floating body on two to {MOST_LEGS} legs of six revolute joints each and nothing else (`lock` fixes other \
         joints); this one has {links} moving links"
    )]
    Legs {
        /// How many links move.
        links: usize,
    },
    /// A leg has no foot, or a foot no leg.
    #[error("one foot at the end of each leg (`feet` names their links); {what}")]
    Feet {
        /// What is wrong.
        what: String,
    },
    /// Gravity has another direction.
    #[error("gravity along −z, of more than 0; this one's is {0:?} m/s²")]
    Gravity([f64; 3]),
    /// A number cannot be a limit, or the supervisor's arithmetic cannot hold it.
    #[error("limits that a supervisor can hold; here {0}")]
    Limits(String),
    /// Core refuses it.
    #[error("links that core takes: {0:?}")]
    Tree(TreeFault),
}

impl Robot {
    /// Of a robot file's robot, whose feet are at the ends of its legs.
    ///
    /// # Errors
    /// A [`NoLeggedRobot`].
    pub fn of_file(file: &FileRobot) -> Result<Self, NoLeggedRobot> {
        let links = file.links.len();
        let leg_count = legs(file).ok_or(NoLeggedRobot::Legs { links })?;
        let [x, y, z] = file.gravity;
        if !(x == 0.0 && y == 0.0 && z < 0.0) {
            return Err(NoLeggedRobot::Gravity(file.gravity));
        }
        let tree = SizedTree::try_new(&core_links(file), file.gravity)
            .ok_or(NoLeggedRobot::Legs { links })?
            .map_err(NoLeggedRobot::Tree)?;
        let feet = (0..leg_count).map(|leg| foot(file, leg)).collect::<Result<Vec<_>, _>>()?;
        if let Some(other) = file.feet.iter().find(|foot| foot.link % LEG != 0 || foot.link == 0) {
            let what = format!("{} is at the end of none", other.name);
            return Err(NoLeggedRobot::Feet { what });
        }
        let joints: Vec<String> =
            file.links.iter().skip(1).map(|link| link.joint.name.clone()).collect();
        let mut robot = Self {
            name: file.name.clone(),
            bodies: file.links.iter().map(|link| link.name.clone()).collect(),
            columns: joints.clone(),
            legs: feet.iter().map(|foot| format!("leg to {}", foot.name)).collect(),
            shapes: shapes(&file.links, &feet),
            joints,
            feet,
            tree,
            small_bodies: &[],
            passive: file.links.iter().skip(1).map(passive).collect(),
            limits: Limits::none(),
            fallen_height: 0.0,
        };
        let height = stance::height(&robot, &vec![0.0; robot.joint_count()]);
        robot.limits = Limits::of_file(file, &robot, height);
        robot.fallen_height = FALLEN * height;
        check_limits(&robot)?;
        Ok(robot)
    }
}

/// What the file says that resists in a link's joint.
fn passive(link: &RobotLink) -> Passive {
    let JointProperties { damping, friction, .. } = link.joint.properties;
    Passive { damping, friction }
}

/// Both precisions hold the limits.
fn check_limits(robot: &Robot) -> Result<(), NoLeggedRobot> {
    with_tree!(&robot.tree, _tree, LEGS => {
        let limits = robot.limits.sized::<LEGS>();
        let limits = limits.ok_or_else(|| NoLeggedRobot::Limits("some are missing".into()))?;
        limits.check().map_err(|error| NoLeggedRobot::Limits(error.to_string()))?;
        limits.to_f32().check().map_err(|error| NoLeggedRobot::Limits(error.to_string()))
    })
}

/// The foot of a leg, in the frame of its last body.
fn foot(file: &FileRobot, leg: usize) -> Result<Foot, NoLeggedRobot> {
    let body = LEG * (leg + 1);
    let mut own = file.feet.iter().filter(|foot| foot.link == body);
    let refuse = |what: String| NoLeggedRobot::Feet { what };
    let last = &file.links[body];
    let (foot, other) = (own.next(), own.next());
    let foot = foot.ok_or_else(|| refuse(format!("none is on {}", last.name)))?;
    if let Some(other) = other {
        return Err(refuse(format!("{} and {} are on the same leg", foot.name, other.name)));
    }
    let center = last.inertial.center;
    let point = |(k, at): (usize, &Vector3<f64>)| FootPoint {
        column: format!("{}_point_{}", foot.name, k + 1),
        at: at - center,
    };
    let middle = foot.points.iter().sum::<Vector3<f64>>() / foot.points.len().max(1) as f64;
    // Robots face along x.
    let end = |is_ahead: bool| -> Vec<usize> {
        let there = |p: &Vector3<f64>| if is_ahead { p.x > middle.x } else { p.x < middle.x };
        foot.points.iter().enumerate().filter(|(_, p)| there(p)).map(|(k, _)| k).collect()
    };
    Ok(Foot {
        name: foot.name.clone(),
        column: foot.name.clone(),
        body,
        points: foot.points.iter().enumerate().map(point).collect(),
        ends: [end(false), end(true)],
    })
}

/// Links as bars from joint to joint, feet as boxes around their points and their joint, the central body as the
/// uniform box of its mass and moments of inertia; in the bodies' frames.
fn shapes(links: &[RobotLink], feet: &[Foot]) -> Vec<Solid> {
    let shape = |(k, link): (usize, &RobotLink)| {
        let center = link.inertial.center;
        let own = link.joint.point - center;
        if let Some(foot) = feet.iter().find(|foot| foot.body == k) {
            let points = foot.points.iter().map(|point| point.at);
            return around(points.chain([own]));
        }
        let children = links.iter().filter(|child| child.parent == Some(k));
        let ends = children
            .map(|child| child.joint.pose_at(0.0) * nalgebra::Point3::from(child.joint.point));
        let mut ends = ends.map(|end| end.coords - center);
        let (mass, inertia) = (link.inertial.mass, &link.inertial.inertia);
        if k == 0 {
            return Solid::uniform_box(mass, inertia)
                .unwrap_or_else(|| around(ends.chain([Vector3::zeros()])));
        }
        let thick = LEAST_THICKNESS * (mass / WATER).cbrt();
        bar(own, ends.next().unwrap_or_default(), thick)
    };
    links.iter().enumerate().map(shape).collect()
}

/// The box along the axes around some points, at least a little thick.
fn around(points: impl Iterator<Item = Vector3<f64>>) -> Solid {
    let (mut low, mut high) = (Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY));
    for point in points {
        low = low.inf(&point);
        high = high.sup(&point);
    }
    let size = high - low;
    let least = THICKNESS * size.norm();
    let edges = size.map(|edge| edge.max(least));
    Solid::cuboid(edges.into()).moved(&Matrix3::identity(), (low + high) / 2.0)
}

/// A square bar between two points, at least so thick (m).
fn bar(from: Vector3<f64>, to: Vector3<f64>, least: f64) -> Solid {
    let along = to - from;
    let length = along.norm();
    let turn = nalgebra::Rotation3::rotation_between(&Vector3::z(), &along).unwrap_or_else(|| {
        nalgebra::Rotation3::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI)
    });
    let thick = least.max(THICKNESS * length);
    Solid::cuboid([thick, thick, length.max(least)]).moved(turn.matrix(), (from + to) / 2.0)
}

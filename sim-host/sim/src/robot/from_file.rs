//! A robot of a file as scenes take it: its tree, names, feet, limits, and what it looks like.

use super::contacts;
use super::{
    Contacts, Foot, FootPoint, LEG, Limits, MOST_LEGS, Passive, Robot, SizedTree, stance, with_tree,
};
use crate::picture::Solid;
use nalgebra::{Matrix3, Vector3};
use surefoot::model::TreeFault;
use surefoot_robots::{
    Foot as FileFoot, JointProperties, Robot as FileRobot, RobotLink, RobotMotion, core_links, legs,
};

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
    /// Its first link does not float.
    #[error("a floating body on legs; here {0} does not float")]
    Central(String),
    /// A joint is none that it moves, or there are too many.
    #[error(
        "at most {most} revolute or prismatic joints that follow no other (`lock` fixes joints); {what}",
        most = super::sized_tree::MOST_JOINTS
    )]
    Joints {
        /// What is wrong.
        what: String,
    },
    /// A foot has no leg.
    #[error("one to {MOST_LEGS} feet, each at the end of a leg (`feet` names their links); {what}")]
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
        let [x, y, z] = file.gravity;
        if !(x == 0.0 && y == 0.0 && z < 0.0) {
            return Err(NoLeggedRobot::Gravity(file.gravity));
        }
        let tree =
            match legs(file).and_then(|_| SizedTree::try_new(&core_links(file), file.gravity)) {
                Some(tree) if feet_are_at_the_ends(file) => tree,
                _ => any_tree(file)?,
            };
        let tree = tree.map_err(NoLeggedRobot::Tree)?;
        let feet = match tree.is_six_jointed() {
            true => (0..file.feet.len()).map(|leg| foot_of_leg(file, leg)).collect(),
            false => file.feet.iter().map(|own| as_one_point(foot(file, own))).collect::<Vec<_>>(),
        };
        let joints: Vec<String> =
            file.links.iter().skip(1).map(|link| link.joint.name.clone()).collect();
        let mut robot = Self {
            name: file.name.clone(),
            bodies: file.links.iter().map(|link| link.name.clone()).collect(),
            columns: joints.clone(),
            slides: file
                .links
                .iter()
                .skip(1)
                .map(|link| link.joint.motion == RobotMotion::Prismatic)
                .collect(),
            legs: feet.iter().map(|foot| format!("leg to {}", foot.name)).collect(),
            leg_joints: (0..feet.len()).map(|leg| (LEG * leg..LEG * (leg + 1)).collect()).collect(),
            shapes: shapes(&file.links, &feet),
            joints,
            feet,
            tree,
            small_bodies: &[],
            passive: file.links.iter().skip(1).map(passive).collect(),
            limits: Limits::none(),
            fallen_height: 0.0,
        };
        if !robot.tree.is_six_jointed() {
            robot.leg_joints = Contacts::of(&robot)?.leg_joints;
        }
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

/// Whether each leg of six joints has one foot, at its end, and no other link has one.
fn feet_are_at_the_ends(file: &FileRobot) -> bool {
    let mut links: Vec<usize> = file.feet.iter().map(|foot| foot.link).collect();
    links.sort_unstable();
    let ends = (1..file.links.len()).filter(|link| link.is_multiple_of(LEG));
    links.into_iter().eq(ends)
}

/// Of a robot with other joints.
fn any_tree(file: &FileRobot) -> Result<Result<SizedTree, TreeFault>, NoLeggedRobot> {
    let refuse = |what: String| NoLeggedRobot::Joints { what };
    let (central, rest) = match file.links.split_first() {
        Some((central, rest)) if central.joint.motion == RobotMotion::Floating => (central, rest),
        Some((other, _)) => return Err(NoLeggedRobot::Central(other.name.clone())),
        None => return Err(NoLeggedRobot::Central("nothing".into())),
    };
    for link in rest {
        let joint = &link.joint;
        if !joint.motion.has_axis() {
            return Err(refuse(format!("{} is neither", joint.name)));
        }
        if joint.follows.is_some() {
            return Err(refuse(format!("{} follows another", joint.name)));
        }
        if link.parent.is_none() {
            return Err(refuse(format!("{} does not hang from {}", link.name, central.name)));
        }
    }
    if file.feet.is_empty() || file.feet.len() > MOST_LEGS {
        let what = format!("it has {}", file.feet.len());
        return Err(NoLeggedRobot::Feet { what });
    }
    SizedTree::of_any(&core_links(file), file.gravity)
        .ok_or_else(|| refuse(format!("it has {}", rest.len())))
}

/// Both precisions hold the limits.
fn check_limits(robot: &Robot) -> Result<(), NoLeggedRobot> {
    let missing = || NoLeggedRobot::Limits("some are missing".into());
    let wrong = |error: surefoot::balance::LimitError| NoLeggedRobot::Limits(error.to_string());
    with_tree!(&robot.tree, _tree, LEGS => {
        let limits = robot.limits.sized::<LEGS>().ok_or_else(missing)?;
        limits.check().map_err(wrong)?;
        limits.to_f32().check().map_err(wrong)
    }, _tree, ROWS => {
        let limits = robot.limits.in_rows::<ROWS>().ok_or_else(missing)?;
        limits.check().map_err(wrong)?;
        limits.to_f32().check().map_err(wrong)
    })
}

/// The foot at the end of a leg of six joints.
fn foot_of_leg(file: &FileRobot, leg: usize) -> Foot {
    let body = LEG * (leg + 1);
    let own = file.feet.iter().find(|foot| foot.link == body);
    foot(file, own.unwrap_or(&file.feet[leg]))
}

/// A foot, in the frame of its body.
fn foot(file: &FileRobot, foot: &FileFoot) -> Foot {
    let body = foot.link;
    let center = file.links[body].inertial.center;
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
    Foot {
        name: foot.name.clone(),
        column: foot.name.clone(),
        body,
        points: foot.points.iter().enumerate().map(point).collect(),
        ends: [end(false), end(true)],
    }
}

/// A foot whose points lie so near each other that the controller takes it for a point: it is one to the floor as well.
fn as_one_point(mut foot: Foot) -> Foot {
    let middle = foot.points.iter().fold(Vector3::zeros(), |sum, point| sum + point.at)
        / foot.points.len() as f64;
    let is_small =
        foot.points.iter().all(|point| 2.0 * (point.at - middle).norm() < contacts::LEAST_LENGTH);
    if is_small && let Some(first) = foot.points.first_mut() {
        first.at = middle;
        foot.points.truncate(1);
        foot.ends = [Vec::new(), Vec::new()];
    }
    foot
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

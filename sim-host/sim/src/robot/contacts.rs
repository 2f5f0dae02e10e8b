//! The contacts of a robot's feet as the whole-body controller takes them: what their points span, as far as their
//! legs have the joints for it.

use super::{Foot, NoLeggedRobot, Robot, with_tree};
use crate::plant::PlantState;
use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use surefoot::balance::{
    ContactLimits, ContactPatch, WholeBody, WholeBodyFoot, WholeBodyRobotFault,
};
use surefoot::spatial::{Pose, Quaternion};

/// Points span a length from here on, m.
pub(super) const LEAST_LENGTH: f64 = 8e-3;
/// Joints that a sole and an edge need.
const SOLE: usize = 6;
const EDGE: usize = 5;

/// Feet and legs.
pub(crate) struct Contacts {
    /// Patches with no limits yet.
    pub feet: [Option<WholeBodyFoot<f64>>; 4],
    /// Joints of each leg, hip to foot.
    pub leg_joints: Vec<Vec<usize>>,
}

impl Contacts {
    /// Of a robot: a foot whose points span an area is a sole, or an edge where its leg has five joints (along the
    /// direction about which its last joint cannot turn it), or a point where it has fewer.
    pub fn of(robot: &Robot) -> Result<Self, NoLeggedRobot> {
        let home = PlantState::home(robot.joint_count());
        let poses = robot.tree.body_poses(&home.positions).unwrap_or_default();
        let as_points = feet(robot, |foot| contact(robot, foot, &poses, 0));
        let leg_joints = legs(robot, &as_points)?;
        let feet = feet(robot, |foot| {
            let leg = robot.feet.iter().position(|other| other.body == foot.body).unwrap_or(0);
            contact(robot, foot, &poses, leg_joints[leg].len())
        });
        legs(robot, &feet)?;
        Ok(Self { feet, leg_joints })
    }
}

fn feet(
    robot: &Robot,
    contact: impl Fn(&Foot) -> WholeBodyFoot<f64>,
) -> [Option<WholeBodyFoot<f64>>; 4] {
    std::array::from_fn(|number| robot.feet.get(number).map(&contact))
}

/// The legs that core finds.
fn legs(
    robot: &Robot,
    feet: &[Option<WholeBodyFoot<f64>>; 4],
) -> Result<Vec<Vec<usize>>, NoLeggedRobot> {
    let refuse = |fault: WholeBodyRobotFault| {
        let foot = |number: usize| robot.feet.get(number).map_or("?", |foot| foot.name.as_str());
        let what = match fault {
            WholeBodyRobotFault::ShortLeg { foot: number, joints, directions } => format!(
                "the leg to {} has {joints} joints of its own, and needs {directions}",
                foot(number)
            ),
            WholeBodyRobotFault::Foot { foot: number } => format!("{} cannot stand", foot(number)),
            other => other.to_string(),
        };
        NoLeggedRobot::Feet { what }
    };
    with_tree!(&robot.tree, tree => {
        let found = WholeBody::new(tree, feet).map_err(refuse)?;
        let leg = |number: usize| {
            let mut joints: Vec<usize> = found.leg(number).map(|velocity| velocity - 6).collect();
            joints.reverse();
            joints
        };
        Ok((0..robot.feet.len()).map(leg).collect())
    })
}

/// A foot's contact, for a leg of so many joints.
fn contact(robot: &Robot, foot: &Foot, poses: &[Pose<f64>], joints: usize) -> WholeBodyFoot<f64> {
    let identity = Pose::identity();
    let pose = poses.get(foot.body).unwrap_or(&identity);
    // As the robot is described with all joints at 0.
    let at_home = |at: &Vector3<f64>| pose.rotation * at;
    let points: Vec<Vector3<f64>> = foot.points.iter().map(|point| at_home(&point.at)).collect();
    let low = points.iter().fold(Vector3::repeat(f64::INFINITY), |low, p| low.inf(p));
    let high = points.iter().fold(Vector3::repeat(f64::NEG_INFINITY), |high, p| high.sup(p));
    let (middle, size) = match points.is_empty() {
        true => (Vector3::zeros(), Vector3::zeros()),
        false => ((low + high) / 2.0, high - low),
    };
    let [long, wide] = [size.x, size.y].map(|length| length > LEAST_LENGTH);
    let half = |length: f64| [-0.5 * length, 0.5 * length];
    let patch = match (long, wide) {
        (true, true) if joints >= SOLE => ContactPatch::sole(half(size.x), half(size.y), 0.0),
        (true, true) if joints >= EDGE => match turns_about_y(robot, foot, poses) {
            true => ContactPatch::edge_along_x(size.x),
            false => ContactPatch::edge_along_y(size.y),
        },
        (true, false) if joints >= EDGE => ContactPatch::edge_along_x(size.x),
        (false, true) if joints >= EDGE => ContactPatch::edge_along_y(size.y),
        _ => ContactPatch::point(),
    };
    let turned = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(
        pose.rotation.transpose(),
    ));
    WholeBodyFoot {
        body: foot.body,
        reference: pose.rotation.tr_mul(&middle),
        axes: Quaternion::from_array([turned.w, turned.i, turned.j, turned.k]),
        limits: ContactLimits {
            least_force: 0.0,
            greatest_force: f64::INFINITY,
            friction: 1.0,
            patch,
            torques: [],
        },
    }
}

/// Whether a foot's joint turns it about y more than about x.
fn turns_about_y(robot: &Robot, foot: &Foot, poses: &[Pose<f64>]) -> bool {
    let rotation = poses.get(foot.body).map_or(Matrix3::identity(), |pose| pose.rotation);
    let axis = robot.tree.body_shape(foot.body).map_or(Vector3::zeros(), |shape| shape.axis);
    let axis = rotation * axis;
    axis.y.abs() >= axis.x.abs()
}

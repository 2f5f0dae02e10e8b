//! How a robot with any legs stands: its feet as they are with all joints at 0, its legs shorter than there, its centre
//! of mass over the middle of its feet. What is no leg stays at 0, or as near to it as it can be.

use super::stance::{
    BENT, CLOSE, DAMPING, LONGEST, MARGIN, ROUNDS, STEPS, joint, off_middle, on_floor,
};
use super::{Contacts, Robot};
use crate::plant::PlantState;
use nalgebra::{DMatrix, DVector, Matrix3, Rotation3, UnitQuaternion, Vector3};
use surefoot::balance::{ContactPatch, WholeBodyFoot};
use surefoot::spatial::{Pose, Quaternion};

/// How much shorter legs are than with all joints at 0, in the order in which it is tried: on one or two feet, and on
/// more, which stand with legs bent far.
const ON_TWO: [f64; 4] = [0.07, 0.1, 0.05, 0.15];
const ON_FOUR: [f64; 4] = [0.27, 0.2, 0.33, 0.14];
/// Angles whose squares differ by less are one as good as the other.
const EQUAL: f64 = 1e-4;

/// Joint angles (rad) of such a stance; `None` where some leg finds none within its joints' ranges.
pub(super) fn bent(robot: &Robot) -> Option<Vec<f64>> {
    let contacts = Contacts::of(robot).ok()?;
    let shorter = if robot.feet.len() > 2 { ON_FOUR } else { ON_TWO };
    shorter.into_iter().find_map(|share| stance(robot, &contacts, share))
}

/// Where a foot's reference point is to be, and how its sole is turned, in the central body's frame.
struct Target<'a> {
    foot: &'a WholeBodyFoot<f64>,
    joints: &'a [usize],
    at: Vector3<f64>,
    axes: Matrix3<f64>,
}

/// The state in which the central body is at another pose and the feet are where they were; `None` where some leg
/// does not reach.
pub(super) fn moved(robot: &Robot, from: &PlantState, to: &Pose<f64>) -> Option<PlantState> {
    let contacts = Contacts::of(robot).ok()?;
    let poses = robot.tree.body_poses(&from.positions).ok()?;
    let mut angles = from.positions[7..].to_vec();
    for (foot, joints) in contacts.feet.iter().flatten().zip(&contacts.leg_joints) {
        let pose = poses.get(foot.body)?;
        let at = to.inverse().transform_point(pose.transform_point(foot.reference));
        let axes = to.rotation.transpose() * pose.rotation * foot.axes.to_matrix();
        let seed = joints.iter().map(|joint| angles[*joint]).collect();
        let found = search(robot, &angles, &Target { foot, joints, at, axes }, seed)?;
        joints.iter().zip(found).for_each(|(joint, angle)| angles[*joint] = angle);
    }
    let mut state = from.clone();
    let turn = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(to.rotation));
    state.positions[..3].copy_from_slice(to.position.as_slice());
    state.positions[3..7].copy_from_slice(&[turn.w, turn.i, turn.j, turn.k]);
    state.positions[7..].copy_from_slice(&angles);
    Some(state)
}

fn stance(robot: &Robot, contacts: &Contacts, share: f64) -> Option<Vec<f64>> {
    let home = PlantState::home(robot.joint_count());
    let poses = robot.tree.body_poses(&home.positions).ok()?;
    let mut angles: Vec<f64> = (0..robot.joint_count()).map(|k| within(robot, k, 0.0)).collect();
    let mut shift = Vector3::zeros();
    for round in 0..ROUNDS {
        for (foot, joints) in contacts.feet.iter().flatten().zip(&contacts.leg_joints) {
            let hip = joint(robot, &poses, joints.first()? + 1)?.0;
            let mut at = poses.get(foot.body)?.transform_point(foot.reference);
            at.z += share * (hip - at).norm();
            let axes = Matrix3::identity();
            let target = Target { foot, joints, at: at + shift, axes };
            let seeds = match round {
                0 => seeds(joints.len()),
                _ => vec![joints.iter().map(|joint| angles[*joint]).collect()],
            };
            let found = smallest(
                seeds.into_iter().filter_map(|seed| search(robot, &angles, &target, seed)),
            )?;
            joints.iter().zip(found).for_each(|(joint, angle)| angles[*joint] = angle);
        }
        let state = on_floor(robot, &angles, Quaternion::identity());
        let off = off_middle(robot, &state)?;
        shift += off;
        if off.norm() < 1e-6 {
            break;
        }
    }
    Some(angles)
}

/// Each joint bent either way.
fn seeds(joints: usize) -> Vec<Vec<f64>> {
    let seed = |k: usize| {
        let mut seed = vec![0.0; joints];
        seed[k / 2] = if k.is_multiple_of(2) { BENT } else { -BENT };
        seed
    };
    (0..2 * joints).map(seed).collect()
}

/// The first of the smallest: legs that could bend either way all bend the same way.
fn smallest(found: impl Iterator<Item = Vec<f64>>) -> Option<Vec<f64>> {
    let size = |angles: &[f64]| angles.iter().map(|x| x * x).sum::<f64>();
    found.reduce(|best, next| if size(&next) < size(&best) - EQUAL { next } else { best })
}

/// An angle within a joint's range.
fn within(robot: &Robot, joint: usize, angle: f64) -> f64 {
    let Some(limits) = robot.limits.joints.get(joint) else { return angle };
    let [low, high] = limits.angle;
    let margin = MARGIN.min(0.25 * (high - low));
    angle.clamp(low + margin, high - margin)
}

/// By damped least squares in the directions that the foot's contact has.
fn search(
    robot: &Robot,
    angles: &[f64],
    target: &Target<'_>,
    mut own: Vec<f64>,
) -> Option<Vec<f64>> {
    let Target { foot, joints, at, axes: wanted } = target;
    let rows = directions(&foot.limits.patch);
    let mut state = PlantState::home(robot.joint_count());
    state.positions[7..].copy_from_slice(angles);
    let axes = foot.axes.to_matrix();
    for _ in 0..STEPS {
        for (angle, joint) in own.iter_mut().zip(*joints) {
            *angle = within(robot, *joint, *angle);
            state.positions[7 + joint] = *angle;
        }
        let poses = robot.tree.body_poses(&state.positions).ok()?;
        let pose = poses.get(foot.body)?;
        let point = pose.transform_point(foot.reference);
        let turned: Matrix3<f64> = pose.rotation * axes;
        let turn = Rotation3::from_matrix_unchecked(wanted * turned.transpose());
        let turn = UnitQuaternion::from_rotation_matrix(&turn).scaled_axis();
        let way = at - point;
        let all = [way.x, way.y, way.z, turn.x, turn.y, turn.z];
        let left = DVector::from_iterator(rows.len(), rows.iter().map(|row| all[*row]));
        if left.norm() < CLOSE {
            return Some(own);
        }
        let mut jacobian = DMatrix::zeros(rows.len(), joints.len());
        for (column, k) in joints.iter().enumerate() {
            let (origin, axis) = joint(robot, &poses, k + 1)?;
            let slides = robot.slides.get(*k).copied().unwrap_or(false);
            let (linear, angular) = match slides {
                true => (axis, Vector3::zeros()),
                false => (axis.cross(&(point - origin)), axis),
            };
            let all = [linear.x, linear.y, linear.z, angular.x, angular.y, angular.z];
            rows.iter().enumerate().for_each(|(i, row)| jacobian[(i, column)] = all[*row]);
        }
        let square = &jacobian * jacobian.transpose()
            + DMatrix::identity(rows.len(), rows.len()) * DAMPING * DAMPING;
        let step = jacobian.transpose() * square.cholesky()?.solve(&left);
        let short = (LONGEST / step.amax().max(LONGEST)).min(1.0);
        own.iter_mut().zip(step.iter()).for_each(|(angle, step)| *angle += short * step);
    }
    None
}

/// Which of position and rotation about x, y, z a contact holds.
fn directions(patch: &ContactPatch<f64>) -> Vec<usize> {
    let free = patch.moments();
    (0..3).chain((0..3).filter(|k| free[*k]).map(|k| 3 + k)).collect()
}

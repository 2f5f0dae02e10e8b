//! How a robot stands: where its feet are, and with which joint angles its legs are bent and its centre of mass is
//! over its feet.

use super::{Contacts, Foot, LEG, Robot, bent_legs};
use crate::plant::PlantState;
use nalgebra::{Matrix6, Rotation3, UnitQuaternion, Vector3, Vector6};
use surefoot::spatial::{Pose, Quaternion};

/// How much shorter bent legs are than the file's legs with all joints at 0: a straight knee then bends by 40°.
const SHORTER: f64 = 0.06;
/// Where legs start to bend, rad.
pub(super) const BENT: f64 = 0.8;
/// Steps of the search for angles, of the search for the middle, and what is left, m and rad.
pub(super) const STEPS: usize = 300;
pub(super) const ROUNDS: usize = 20;
pub(super) const CLOSE: f64 = 1e-9;
/// What keeps steps short near a singular leg, in units of the Jacobian's (m and 1).
pub(super) const DAMPING: f64 = 1e-3;
/// Longest step, rad.
pub(super) const LONGEST: f64 = 0.3;
/// Angles keep this far from the ends of their joints, rad.
pub(super) const MARGIN: f64 = 0.02;

/// The robot's state with these joint angles (rad), its central body turned, its lowest point on the floor.
pub fn on_floor(robot: &Robot, angles: &[f64], turned: Quaternion<f64>) -> PlantState {
    let mut state = PlantState::home(angles.len());
    state.positions[3..7].copy_from_slice(&turned.to_array());
    state.positions[7..].copy_from_slice(angles);
    let all = robot.foot_points(&state);
    let lowest = all.iter().flatten().map(|point| point.z).fold(f64::INFINITY, f64::min);
    if lowest.is_finite() {
        state.positions[2] = -lowest;
    }
    state
}

/// Height of the central body over the lowest point of its feet, upright, m.
pub(super) fn height(robot: &Robot, angles: &[f64]) -> f64 {
    on_floor(robot, angles, Quaternion::identity()).positions[2]
}

impl Robot {
    /// The points of each foot in the world, m; empty where the state is not a configuration.
    pub fn foot_points(&self, state: &PlantState) -> Vec<Vec<Vector3<f64>>> {
        let poses = self.tree.body_poses(&state.positions).unwrap_or_default();
        let of_foot = |foot: &Foot| {
            let pose = poses.get(foot.body);
            foot.points.iter().filter_map(|point| Some(pose?.transform_point(point.at))).collect()
        };
        self.feet.iter().map(of_foot).collect()
    }
}

/// Joint angles (rad) with which the robot stands upright on bent legs, its soles as they are with all joints at 0,
/// its centre of mass over the middle of its feet; `None` where some leg finds none within its joints' ranges.
pub fn bent(robot: &Robot) -> Option<Vec<f64>> {
    if !robot.tree.is_six_jointed() {
        return bent_legs::bent(robot);
    }
    let home = PlantState::home(robot.joint_count());
    let poses = robot.tree.body_poses(&home.positions).ok()?;
    let mut angles = vec![0.0; robot.joint_count()];
    let mut shift = Vector3::zeros();
    for round in 0..ROUNDS {
        for (leg, foot) in robot.feet.iter().enumerate() {
            let hip = joint(robot, &poses, LEG * leg + 1)?.0;
            let mut target = poses[foot.body];
            target.position.z += SHORTER * (hip - target.position).norm();
            target.position += shift;
            let start = (round > 0).then_some(&angles[LEG * leg..LEG * (leg + 1)]);
            let found = leg_angles(robot, leg, &target, start)?;
            angles[LEG * leg..LEG * (leg + 1)].copy_from_slice(&found);
        }
        let state = on_floor(robot, &angles, Quaternion::identity());
        let off = off_middle(robot, &state)?;
        shift += off;
        if off.norm() < 1e-6 {
            return Some(angles);
        }
    }
    Some(angles)
}

/// From the feet's middle to the centre of mass, along the floor, m.
pub(super) fn off_middle(robot: &Robot, state: &PlantState) -> Option<Vector3<f64>> {
    let poses = robot.tree.body_poses(&state.positions).ok()?;
    let weighted = poses.iter().enumerate().map(|(k, p)| p.position * robot.tree.body_mass(k));
    let center = weighted.sum::<Vector3<f64>>() / robot.tree.mass();
    // The controller loads all feet alike: what counts is the mean of their middles.
    let feet = robot.foot_points(state);
    let middle = feet.iter().map(|foot| middle(foot)).sum::<Vector3<f64>>() / feet.len() as f64;
    let off = center - middle;
    Some(Vector3::new(off.x, off.y, 0.0))
}

/// The state in which the central body is at another pose and the feet are where they were; `None` where some leg
/// does not reach.
pub fn moved(robot: &Robot, from: &PlantState, to: &Pose<f64>) -> Option<PlantState> {
    bent_legs::moved(robot, from, to)
}

/// From the mean of the feet's reference points to the model's centre of mass, along the floor, m; `None` where the
/// state is no configuration.
pub fn center_from_feet(robot: &Robot, state: &PlantState) -> Option<[f64; 2]> {
    let poses = robot.tree.body_poses(&state.positions).ok()?;
    let weighted = poses.iter().enumerate().map(|(k, p)| p.position * robot.tree.body_mass(k));
    let center = weighted.sum::<Vector3<f64>>() / robot.tree.mass();
    let off = center - feet_middle(robot, &poses)?;
    Some([off.x, off.y])
}

/// The mean of the feet's reference points, m.
pub fn feet_middle(robot: &Robot, poses: &[Pose<f64>]) -> Option<Vector3<f64>> {
    let contacts = Contacts::of(robot).ok()?;
    let points = contacts.feet.iter().flatten();
    let points: Option<Vec<_>> =
        points.map(|foot| Some(poses.get(foot.body)?.transform_point(foot.reference))).collect();
    let points = points?;
    Some(points.iter().sum::<Vector3<f64>>() / points.len() as f64)
}

/// The middle of the box around points.
fn middle(points: &[Vector3<f64>]) -> Vector3<f64> {
    let low = points.iter().fold(Vector3::repeat(f64::INFINITY), |low, point| low.inf(point));
    let high = points.iter().fold(Vector3::repeat(f64::NEG_INFINITY), |high, p| high.sup(p));
    (low + high) / 2.0
}

/// A joint's point and axis in the world.
pub(super) fn joint(
    robot: &Robot,
    poses: &[Pose<f64>],
    body: usize,
) -> Option<(Vector3<f64>, Vector3<f64>)> {
    let shape = robot.tree.body_shape(body)?;
    let pose = poses.get(body)?;
    Some((pose.transform_point(shape.joint), pose.rotation * shape.axis))
}

/// Angles of a leg that bring its foot's body to a pose, the smallest of those that are found: by damped least squares
/// from each joint bent either way, or from a start.
fn leg_angles(
    robot: &Robot,
    leg: usize,
    target: &Pose<f64>,
    start: Option<&[f64]>,
) -> Option<[f64; LEG]> {
    let bent = |k: usize| {
        let mut seed = [0.0; LEG];
        seed[k / 2] = if k.is_multiple_of(2) { BENT } else { -BENT };
        seed
    };
    let seeds: Vec<[f64; LEG]> = match start {
        Some(start) => vec![start.try_into().ok()?],
        None => (0..2 * LEG).map(bent).collect(),
    };
    let size = |angles: &[f64; LEG]| angles.iter().map(|x| x * x).sum::<f64>();
    let found = seeds.into_iter().filter_map(|seed| search(robot, leg, target, seed));
    found.min_by(|a, b| size(a).total_cmp(&size(b)))
}

fn search(robot: &Robot, leg: usize, target: &Pose<f64>, seed: [f64; LEG]) -> Option<[f64; LEG]> {
    let mut angles = seed;
    let body = LEG * (leg + 1);
    let mut state = PlantState::home(robot.joint_count());
    for _ in 0..STEPS {
        let own = robot.limits.joints.get(LEG * leg..body)?;
        for (angle, limits) in angles.iter_mut().zip(own) {
            let [low, high] = limits.angle;
            let margin = MARGIN.min(0.25 * (high - low));
            *angle = angle.clamp(low + margin, high - margin);
        }
        state.positions[7 + LEG * leg..7 + body].copy_from_slice(&angles);
        let poses = robot.tree.body_poses(&state.positions).ok()?;
        let at = poses.get(body)?;
        let turn = Rotation3::from_matrix_unchecked(target.rotation * at.rotation.transpose());
        let turn = UnitQuaternion::from_rotation_matrix(&turn).scaled_axis();
        let way = target.position - at.position;
        let left = Vector6::new(way.x, way.y, way.z, turn.x, turn.y, turn.z);
        if left.norm() < CLOSE {
            return Some(angles);
        }
        let mut jacobian = Matrix6::zeros();
        for k in 0..LEG {
            let (point, axis) = joint(robot, &poses, LEG * leg + 1 + k)?;
            jacobian.fixed_view_mut::<3, 1>(0, k).copy_from(&axis.cross(&(at.position - point)));
            jacobian.fixed_view_mut::<3, 1>(3, k).copy_from(&axis);
        }
        let square = jacobian * jacobian.transpose() + Matrix6::identity() * DAMPING * DAMPING;
        let step = jacobian.transpose() * square.cholesky()?.solve(&left);
        let short = (LONGEST / step.amax().max(LONGEST)).min(1.0);
        angles.iter_mut().zip(step.iter()).for_each(|(angle, step)| *angle += short * step);
    }
    None
}

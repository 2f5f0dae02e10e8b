//! What a controller within limits says of a tick, as a record keeps it.

use crate::robot::Robot;
use nalgebra::{Vector2, Vector3};

use super::Sample;

/// Of a tick.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TickNote {
    /// The limit that cost most, where one bound.
    pub limit: Option<NotedLimit>,
    /// Multiplications that its program took, where it is known: a target does not say.
    pub work: Option<u32>,
    /// Where it would have to press to come to rest, by the state that it sees: world, m. Of robots that walk.
    pub capture_point: Option<[f64; 2]>,
}

/// A limit that bound.
#[derive(Clone, Debug, PartialEq)]
pub struct NotedLimit {
    /// `lift`, `press`, `slip`, `tip`, `twist` or `torque`.
    pub limit: &'static str,
    /// Name of the leg or joint.
    pub of: String,
    /// By how much the objective would fall per 100 % of a wider limit.
    pub relief: f64,
}

/// Columns of [`TickNote::row`] for robots that stand; those of ones that walk have two more, after these and
/// [`PRESSURE`].
pub(super) const LIMITS: [&str; 5] =
    ["limit", "limit_of", "limit_relief", "solver_work", "torque_share"];
pub(super) const PRESSURE: [&str; 2] = ["pressure_x_m", "pressure_y_m"];
pub(super) const CAPTURE: [&str; 2] = ["capture_x_m", "capture_y_m"];

/// Fields of a sample in these columns; empty where nothing is known.
pub(super) fn row(robot: &Robot, sample: &Sample, walks: bool) -> Vec<String> {
    let note = sample.note.as_ref();
    let limit = note.and_then(|note| note.limit.as_ref());
    let number = |x: Option<f64>| x.map_or_else(String::new, |x| x.to_string());
    let mut fields = vec![
        limit.map_or_else(String::new, |limit| limit.limit.to_owned()),
        limit.map_or_else(String::new, |limit| limit.of.clone()),
        number(limit.map(|limit| limit.relief)),
        number(note.and_then(|note| note.work).map(f64::from)),
        number(Some(torque_share(robot, sample).1)),
    ];
    let point = |at: Option<[f64; 2]>| {
        let [x, y] = at.map_or([None; 2], |at| at.map(Some));
        [number(x), number(y)]
    };
    let pressure = center_of_pressure(robot, sample);
    fields.extend(point(pressure.map(|point| [point.x, point.y])));
    if walks {
        fields.extend(point(note.and_then(|note| note.capture_point)));
    }
    fields
}

/// The joint whose motor is nearest to its limit, and how near: 1 at the limit.
pub fn torque_share(robot: &Robot, sample: &Sample) -> (usize, f64) {
    let shares = sample.torques.iter().zip(&robot.limits.joints).enumerate();
    let shares = shares.map(|(joint, (torque, limits))| (joint, torque.abs() / limits.torque));
    shares.fold((0, 0.0), |most, share| if share.1 > most.1 { share } else { most })
}

/// Where the ground's pressure on all feet together acts, world, m; `None` where it presses on none.
pub fn center_of_pressure(robot: &Robot, sample: &Sample) -> Option<Vector2<f64>> {
    let forces = sample.corner_forces.as_ref()?;
    let poses = robot.tree.body_poses(&sample.positions).ok()?;
    let (mut moment, mut sum) = (Vector2::zeros(), 0.0);
    for (foot, forces) in robot.feet.iter().zip(forces) {
        let pose = poses.get(foot.body)?;
        for (point, [_, _, up]) in foot.points.iter().zip(forces) {
            let at: Vector3<f64> = pose.transform_point(point.at);
            moment += at.xy() * *up;
            sum += up;
        }
    }
    // What rounding leaves of a robot in the air is no pressure.
    (sum > 1e-3).then(|| moment / sum)
}

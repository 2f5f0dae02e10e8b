//! What the page's replay plays, as JSON: numbers are rounded to what can be seen, and kept in flat lists.

use crate::chart::{Mark, marks};
use crate::picture::{DESIRED_FORCE_LENGTH, FORCE_LENGTH, Shown, Solid, TORQUE_LENGTH, frames};
use crate::record::{Event, Sample};
use nalgebra::{Rotation3, UnitQuaternion};
use serde::Serialize;
use surefoot::spatial::{Pose, Quaternion};

/// All that the replay plays. Names are those that the page's script reads.
#[derive(Debug, Serialize)]
pub(super) struct ReplayData {
    bodies: Vec<Body>,
    /// Points of all feet in their bodies' frames, m.
    corners: Vec<[f64; 3]>,
    /// The body of each of these points.
    feet: Vec<usize>,
    /// The central body at the set point, world frame.
    set_point: Solid,
    block: Option<Solid>,
    force_length: f64,
    desired_force_length: f64,
    torque_length: f64,
    /// s
    pub(super) times: Vec<f64>,
    /// Seven numbers a body and frame: 0.1 mm, and quaternion chapters of 1e-4.
    poses: Vec<i32>,
    block_poses: Vec<i32>,
    /// N
    block_forces: Vec<i32>,
    /// Six numbers a frame: N, N·m, body frame.
    wrench: Vec<f64>,
    /// Three numbers a corner and frame, N.
    forces: Vec<i32>,
    /// A digit a corner and frame: the states of figure 5.1.
    pub(super) contacts: String,
    /// mm and degrees.
    errors: Vec<f64>,
    marks: Vec<Mark>,
}

#[derive(Debug, Serialize)]
struct Body {
    /// 0 the central body, 1 the left leg, 2 the right one, and so on in turn.
    group: u8,
    #[serde(flatten)]
    solid: Solid,
}

impl ReplayData {
    /// Of a run; `None` where there is nothing to play. A run that diverged is played as far as it holds
    /// configurations of the robot.
    pub(super) fn of(shown: &Shown, samples: &[Sample], events: &[Event]) -> Option<Self> {
        let mut data = Self::still(shown, marks(events));
        for i in frames(samples) {
            let sample = &samples[i];
            let Ok(poses) = shown.robot.tree.body_poses(&sample.positions) else { break };
            data.push(sample, &poses);
        }
        (!data.times.is_empty()).then_some(data)
    }

    /// All that does not move.
    fn still(shown: &Shown, marks: Vec<Mark>) -> Self {
        let robot = &shown.robot;
        let group = |k: usize| robot.leg_of(k).map_or(0, |leg| 1 + (leg % 2) as u8);
        let bodies = robot.shapes.iter().enumerate();
        let feet = robot.feet.iter().filter(|_| shown.has_contacts);
        let points = feet.flat_map(|foot| foot.points.iter().map(|point| (foot.body, point.at)));
        let (feet, corners) = points.map(|(body, at)| (body, rounded_point(at.into()))).unzip();
        let target = &shown.set_point;
        let rotation = Quaternion::from_array(target.orientation).to_matrix();
        Self {
            bodies: bodies
                .map(|(k, s)| Body { group: group(k), solid: rounded_solid(s) })
                .collect(),
            corners,
            feet,
            set_point: rounded_solid(
                &robot.shapes[0].clone().moved(&rotation, target.position_m.into()),
            ),
            block: shown.block.as_ref().map(rounded_solid),
            force_length: FORCE_LENGTH,
            desired_force_length: DESIRED_FORCE_LENGTH,
            torque_length: TORQUE_LENGTH,
            times: Vec::new(),
            poses: Vec::new(),
            block_poses: Vec::new(),
            block_forces: Vec::new(),
            wrench: Vec::new(),
            forces: Vec::new(),
            contacts: String::new(),
            errors: Vec::new(),
            marks,
        }
    }

    fn push(&mut self, sample: &Sample, poses: &[Pose<f64>]) {
        self.times.push(rounded(sample.time_s, 1e4));
        for pose in poses {
            let rotation = Rotation3::from_matrix_unchecked(pose.rotation);
            let q = UnitQuaternion::from_rotation_matrix(&rotation);
            let p = pose.position;
            self.poses.extend([p.x, p.y, p.z, q.w, q.i, q.j, q.k].map(ten_thousandths));
        }
        // Where there is no block yet, it is out of sight.
        if self.block.is_some() {
            let (pose, force) = match &sample.block {
                Some(block) => (block.pose, block.force),
                None => ([0.0, 0.0, -10.0, 1.0, 0.0, 0.0, 0.0], [0.0; 3]),
            };
            self.block_poses.extend(pose.map(ten_thousandths));
            self.block_forces.extend(force.map(|f| f.round() as i32));
        }
        self.wrench.extend(sample.desired_wrench.map(|x| rounded(x, 10.0)));
        if let Some(forces) = &sample.corner_forces {
            self.forces.extend(forces.iter().flatten().flatten().map(|f| f.round() as i32));
        }
        if let Some(contacts) = &sample.contacts {
            let digits = contacts.iter().flatten().map(|state| char::from(b'0' + state.number()));
            self.contacts.extend(digits);
        }
        self.errors.push(rounded(1e3 * sample.error_distance(), 1e3));
        self.errors.push(rounded(sample.error_angle().to_degrees(), 1e3));
    }
}

fn ten_thousandths(x: f64) -> i32 {
    (1e4 * x).round() as i32
}

/// To a fraction of 1.
fn rounded(x: f64, per_unit: f64) -> f64 {
    (x * per_unit).round() / per_unit
}

fn rounded_point(point: [f64; 3]) -> [f64; 3] {
    point.map(|x| rounded(x, 1e4))
}

fn rounded_solid(solid: &Solid) -> Solid {
    let vertices = solid.vertices.iter().map(|vertex| rounded_point(*vertex)).collect();
    Solid { vertices, faces: solid.faces.clone() }
}

//! What the page's replay plays, as JSON: numbers are rounded to what can be seen, and kept in flat lists.

use crate::chart::{Mark, marks};
use nalgebra::{Rotation3, UnitQuaternion};
use serde::Serialize;
use surefoot_sim::picture::{
    DESIRED_FORCE_LENGTH, Framing, Moment, Shown, Solid, TORQUE_LENGTH, frames,
};
use surefoot_sim::record::{Event, Record};

/// All that the replay plays. Names are those that the page's script reads.
#[derive(Debug, Serialize)]
pub(super) struct ReplayData {
    /// How many bodies there are.
    bodies: usize,
    solids: Vec<OfBody>,
    /// Points that can touch the floor in their bodies' frames, m.
    corners: Vec<[f64; 3]>,
    /// The body of each of these points.
    feet: Vec<usize>,
    /// The first body where it should be, world frame.
    set_point: Option<Solid>,
    block: Option<Solid>,
    force_length: f64,
    desired_force_length: f64,
    torque_length: f64,
    view: Framing,
    /// What positions are counted in, m.
    unit: f64,
    /// s
    pub(super) times: Vec<f64>,
    /// Seven numbers a body and frame: position, and quaternion in parts of 1e-4.
    poses: Vec<i32>,
    block_poses: Vec<i32>,
    /// N
    block_forces: Vec<i32>,
    /// Six numbers a frame: N, N·m, body frame.
    wrench: Vec<f64>,
    /// Three numbers a corner and frame.
    forces: Vec<i32>,
    /// What these are counted in, N.
    force_unit: f64,
    /// A digit a corner and frame: the states of figure 5.1.
    pub(super) contacts: String,
    /// mm and degrees.
    errors: Vec<f64>,
    marks: Vec<Mark>,
}

#[derive(Debug, Serialize)]
struct OfBody {
    /// None for what stands in the world.
    body: Option<usize>,
    group: u8,
    #[serde(flatten)]
    solid: Solid,
}

/// Colour of what stands in the world.
const STANDING: u8 = 4;

impl ReplayData {
    /// Of a run; `None` where there is nothing to play. A run that diverged is played as far as it holds
    /// configurations.
    pub(super) fn of(record: &dyn Record, events: &[Event]) -> Option<Self> {
        let times = record.times();
        let mut data = Self::still(record.shown(), marks(events));
        for i in frames(&times, data.bodies) {
            let Ok(moment) = record.moment(i) else { break };
            if !moment.poses.iter().all(|pose| pose.position.iter().all(|x| x.is_finite())) {
                break;
            }
            data.push(times[i], &moment);
        }
        (!data.times.is_empty()).then_some(data)
    }

    /// All that does not move.
    fn still(shown: &Shown, marks: Vec<Mark>) -> Self {
        // A robot as large as a person is counted in tenths of a millimetre.
        let unit = 1e-4 * (shown.framing.distance / Framing::OF_A_PERSON.distance);
        let rounded = |solid: &Solid| rounded_solid(solid, unit);
        let bodies = shown.bodies.iter().enumerate();
        let of_bodies = bodies.flat_map(|(k, body)| {
            let of_body = move |solid: &Solid| OfBody {
                body: Some(k),
                group: body.group,
                solid: rounded_solid(solid, unit),
            };
            body.solids.iter().map(of_body)
        });
        let standing =
            shown.pivots.iter().map(|s| OfBody { body: None, group: STANDING, solid: rounded(s) });
        let points = shown.points.iter();
        Self {
            bodies: shown.bodies.len(),
            solids: of_bodies.chain(standing).collect(),
            corners: points.clone().map(|p| rounded_point(p.at.into(), unit)).collect(),
            feet: points.map(|point| point.body).collect(),
            set_point: shown.goal.as_ref().map(rounded),
            block: shown.block.as_ref().map(rounded),
            force_length: shown.force_length,
            desired_force_length: DESIRED_FORCE_LENGTH,
            torque_length: TORQUE_LENGTH,
            view: shown.framing,
            unit,
            times: Vec::new(),
            poses: Vec::new(),
            block_poses: Vec::new(),
            block_forces: Vec::new(),
            wrench: Vec::new(),
            forces: Vec::new(),
            // What a millimetre of an arrow stands for.
            force_unit: if shown.force_length > 0.0 { 1e-3 / shown.force_length } else { 1.0 },
            contacts: String::new(),
            errors: Vec::new(),
            marks,
        }
    }

    fn push(&mut self, time_s: f64, moment: &Moment) {
        self.times.push(rounded(time_s, 1e4));
        for pose in &moment.poses {
            let rotation = Rotation3::from_matrix_unchecked(pose.rotation);
            let q = UnitQuaternion::from_rotation_matrix(&rotation);
            self.poses.extend(pose.position.iter().map(|x| (x / self.unit).round() as i32));
            self.poses.extend([q.w, q.i, q.j, q.k].map(ten_thousandths));
        }
        // Where there is no block yet, it is out of sight.
        if self.block.is_some() {
            let (pose, force) = match &moment.block {
                Some(block) => (block.pose, block.force),
                None => ([0.0, 0.0, -10.0, 1.0, 0.0, 0.0, 0.0], [0.0; 3]),
            };
            self.block_poses.extend(pose[..3].iter().map(|x| (x / self.unit).round() as i32));
            self.block_poses.extend(pose[3..].iter().map(|x| ten_thousandths(*x)));
            self.block_forces.extend(force.map(|f| f.round() as i32));
        }
        let forces = moment.forces.iter().flatten();
        self.forces.extend(forces.map(|f| (f / self.force_unit).round() as i32));
        self.contacts.extend(moment.contacts.iter().map(|state| char::from(b'0' + state.number())));
        if let Some(tracking) = &moment.tracking {
            self.wrench.extend(tracking.desired_wrench.map(|x| rounded(x, 10.0)));
            self.errors.push(rounded(1e3 * tracking.distance, 1e3));
            self.errors.push(rounded(tracking.angle.to_degrees(), 1e3));
        }
    }
}

fn ten_thousandths(x: f64) -> i32 {
    (1e4 * x).round() as i32
}

/// To a fraction of 1.
fn rounded(x: f64, per_unit: f64) -> f64 {
    (x * per_unit).round() / per_unit
}

/// A power of ten of steps to 1, so that a step is no longer than `step`.
fn decimal(step: f64) -> f64 {
    10.0_f64.powi((-step.log10() - 1e-9).ceil() as i32)
}

fn rounded_point(point: [f64; 3], unit: f64) -> [f64; 3] {
    point.map(|x| rounded(x, decimal(unit)))
}

fn rounded_solid(solid: &Solid, unit: f64) -> Solid {
    let vertices = solid.vertices.iter().map(|vertex| rounded_point(*vertex, unit)).collect();
    Solid { vertices, faces: solid.faces.clone() }
}

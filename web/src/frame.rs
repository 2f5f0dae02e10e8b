//! What a page draws.

use crate::live::Live;
use nalgebra::{Rotation3, UnitQuaternion};
use serde::Serialize;
use surefoot_sim::closed_loop::LimitTally;
use surefoot_sim::picture::{Framing, Shown, Solid};

/// What stands still. Lengths in m, in the frames of the bodies.
#[derive(Clone, Debug, Serialize)]
pub struct Still {
    /// What the scene says of itself.
    pub description: String,
    /// Solids of the bodies, with the number of the colour.
    pub solids: Vec<OfBody>,
    /// Points that can touch the floor.
    pub points: Vec<[f64; 3]>,
    /// The body of each.
    pub bodies: Vec<usize>,
    /// Names of the joints.
    pub joints: Vec<String>,
    /// Their greatest torques, N·m.
    pub torque_limits: Vec<f64>,
    /// From where it is looked at.
    pub view: Framing,
    /// Length of an arrow for a force of the floor, m/N.
    pub force_length: f64,
    /// A tick, s.
    pub tick_s: f64,
}

/// A solid of a body.
#[derive(Clone, Debug, Serialize)]
pub struct OfBody {
    body: usize,
    group: u8,
    #[serde(flatten)]
    solid: Solid,
}

/// What moves, at an instant.
#[derive(Clone, Debug, Serialize)]
pub struct Frame {
    /// s
    pub time_s: f64,
    /// Position (m) and quaternion, scalar first, of each body in the world.
    pub poses: Vec<[f64; 7]>,
    /// States of figure 5.1 of the points, where the plant knows them.
    pub contacts: Vec<u8>,
    /// Forces of the floor on them, N, world frame.
    pub forces: Vec<[f64; 3]>,
    /// Torques of the joints, N·m.
    pub torques: Vec<f64>,
    /// What pushes, N, world frame.
    pub push: Option<[f64; 3]>,
    /// What limits of floor and motors have done so far.
    pub limits: Option<LimitTally>,
    /// Why the supervisor has stopped the robot.
    pub stopped: Option<String>,
    /// Why the run has ended.
    pub failure: Option<String>,
}

impl Still {
    pub(crate) fn of(live: &Live) -> Self {
        let shown = Shown::of(&live.scene);
        let of_body = |(body, shown): (usize, &surefoot_sim::picture::ShownBody)| {
            let group = shown.group;
            let solids = shown.solids.clone().into_iter();
            solids.map(move |solid| OfBody { body, group, solid }).collect::<Vec<_>>()
        };
        Self {
            description: live.scene.description.clone(),
            solids: shown.bodies.iter().enumerate().flat_map(of_body).collect(),
            points: shown.points.iter().map(|point| point.at.into()).collect(),
            bodies: shown.points.iter().map(|point| point.body).collect(),
            joints: live.robot.joints.clone(),
            torque_limits: live.robot.limits.joints.iter().map(|joint| joint.torque).collect(),
            view: shown.framing,
            force_length: shown.force_length,
            tick_s: 1.0 / live.scene.controller.rate_hz,
        }
    }
}

impl Frame {
    pub(crate) fn of(live: &mut Live) -> Result<Self, String> {
        let fault = |failure: &dyn std::fmt::Display| failure.to_string();
        let poses = live.robot.tree.body_poses(&live.state.positions).map_err(|e| fault(&e))?;
        let seen = live.plant.observe().map_err(|e| fault(&e))?;
        let pose = |pose: &surefoot::spatial::Pose<f64>| {
            let rotation = Rotation3::from_matrix_unchecked(pose.rotation);
            let q = UnitQuaternion::from_rotation_matrix(&rotation);
            let [x, y, z] = pose.position.into();
            [x, y, z, q.w, q.i, q.j, q.k]
        };
        Ok(Self {
            time_s: live.time_s(),
            poses: poses.iter().map(pose).collect(),
            contacts: seen.contacts.into_iter().flatten().flatten().map(|s| s.number()).collect(),
            forces: seen.corner_forces.into_iter().flatten().flatten().collect(),
            torques: live.command.torques.clone(),
            push: live.pushing(),
            limits: live.controller.limits(),
            stopped: live.controller.stopped().map(|reason| reason.to_string()),
            failure: live.failure.clone(),
        })
    }
}

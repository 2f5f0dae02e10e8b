//! The messages of a sample.

use super::arrows::arrow;
use super::nanoseconds;
use crate::chart::OKABE_ITO;
use crate::picture::{DESIRED_FORCE_LENGTH, FORCE_LENGTH, Shown, Solid, TORQUE_LENGTH};
use crate::record::{Event, Sample};
use crate::robot::Robot;
use ::foxglove::messages::log::Level;
use ::foxglove::messages::{
    Color, FrameTransform, FrameTransforms, JointState, JointStates, Log, Point3, Quaternion,
    SceneEntity, SceneUpdate, Timestamp, TriangleListPrimitive, Vector3 as FoxgloveVector,
};
use nalgebra::{Rotation3, UnitQuaternion, Vector3};
use surefoot::spatial::Pose;

const WORLD: &str = "world";
const BLOCK: &str = "block";

/// A body's frame: its name without spaces.
fn frame(body: &str) -> String {
    body.replace(", ", "_").replace(' ', "_")
}

fn timestamp(time_s: f64) -> Option<Timestamp> {
    let time = nanoseconds(time_s);
    let (seconds, rest) = (time / 1_000_000_000, time % 1_000_000_000);
    Timestamp::new_checked(u32::try_from(seconds).ok()?, u32::try_from(rest).ok()?)
}

pub(super) fn vector(v: Vector3<f64>) -> FoxgloveVector {
    FoxgloveVector { x: v.x, y: v.y, z: v.z }
}

pub(super) fn quaternion(q: &UnitQuaternion<f64>) -> Quaternion {
    Quaternion { x: q.i, y: q.j, z: q.k, w: q.w }
}

fn color(index: usize, alpha: f64) -> Color {
    let (r, g, b) = OKABE_ITO[index];
    let part = |part: u8| f64::from(part) / 255.0;
    Color { r: part(r), g: part(g), b: part(b), a: alpha }
}

/// Frames of all bodies, and of the block, in the world's.
pub(super) fn transforms(robot: &Robot, sample: &Sample, poses: &[Pose<f64>]) -> FrameTransforms {
    let transform = |child: String, position: Vector3<f64>, rotation: Quaternion| FrameTransform {
        timestamp: timestamp(sample.time_s),
        parent_frame_id: WORLD.to_owned(),
        child_frame_id: child,
        translation: Some(vector(position)),
        rotation: Some(rotation),
    };
    let mut transforms: Vec<FrameTransform> = robot
        .bodies
        .iter()
        .zip(poses)
        .map(|(body, pose)| {
            let rotation = Rotation3::from_matrix_unchecked(pose.rotation);
            let rotation = quaternion(&UnitQuaternion::from_rotation_matrix(&rotation));
            transform(frame(body), pose.position, rotation)
        })
        .collect();
    if let Some(block) = &sample.block {
        let [x, y, z, w, i, j, k] = block.pose;
        let rotation = Quaternion { x: i, y: j, z: k, w };
        transforms.push(transform(BLOCK.to_owned(), Vector3::new(x, y, z), rotation));
    }
    FrameTransforms { transforms }
}

/// Solids that go with their frames, and a ghost at the set point.
pub(super) fn robot(shown: &Shown, time_s: f64) -> SceneUpdate {
    let mut entities: Vec<SceneEntity> = shown
        .robot
        .bodies
        .iter()
        .zip(&shown.robot.shapes)
        .enumerate()
        .map(|(k, (body, solid))| {
            let of_leg = match shown.robot.leg_of(k) {
                None => color(2, 1.0),
                Some(leg) if leg % 2 == 0 => color(5, 1.0),
                Some(_) => color(3, 1.0),
            };
            solid_entity(time_s, &frame(body), body, solid, of_leg)
        })
        .collect();
    if let Some(block) = &shown.block {
        entities.push(solid_entity(time_s, BLOCK, BLOCK, block, color(4, 1.0)));
    }
    let [s, i, j, k] = shown.set_point.orientation;
    let rotation = surefoot::spatial::Quaternion::from_array([s, i, j, k]).to_matrix();
    let ghost = shown.robot.shapes[0].clone().moved(&rotation, shown.set_point.position_m.into());
    entities.push(solid_entity(time_s, WORLD, "set point", &ghost, color(0, 0.15)));
    SceneUpdate { deletions: Vec::new(), entities }
}

fn solid_entity(time_s: f64, frame: &str, id: &str, solid: &Solid, color: Color) -> SceneEntity {
    // A convex face is a fan of triangles.
    let triangles = solid.faces.iter().flat_map(|face| {
        face.windows(2).skip(1).flat_map(|pair| [face[0] as u32, pair[0] as u32, pair[1] as u32])
    });
    SceneEntity {
        timestamp: timestamp(time_s),
        frame_id: frame.to_owned(),
        id: id.to_owned(),
        frame_locked: true,
        triangles: vec![TriangleListPrimitive {
            points: solid.vertices.iter().map(|[x, y, z]| Point3 { x: *x, y: *y, z: *z }).collect(),
            color: Some(color),
            indices: triangles.collect(),
            ..TriangleListPrimitive::default()
        }],
        ..SceneEntity::default()
    }
}

/// The forces of the ground and of the block, and the wrench that the controller asks for. Each message
/// replaces the one before, as the entity's name is the same.
pub(super) fn forces(shown: &Shown, sample: &Sample, poses: &[Pose<f64>]) -> SceneUpdate {
    let mut arrows = Vec::new();
    if let Some(forces) = sample.corner_forces.as_ref().filter(|_| shown.has_contacts) {
        for (foot, forces) in shown.robot.feet.iter().zip(forces) {
            for (point, force) in foot.points.iter().zip(forces) {
                let at = poses[foot.body].transform_point(point.at);
                arrows.extend(arrow(at, Vector3::from(*force) * FORCE_LENGTH, color(1, 1.0)));
            }
        }
    }
    let body = &poses[0];
    let [fx, fy, fz, tx, ty, tz] = sample.desired_wrench;
    let force = body.rotation * Vector3::new(fx, fy, fz) * DESIRED_FORCE_LENGTH;
    let torque = body.rotation * Vector3::new(tx, ty, tz) * TORQUE_LENGTH;
    arrows.extend(arrow(body.position, force, color(0, 1.0)));
    arrows.extend(arrow(body.position, torque, color(2, 1.0)));
    if let Some(block) = &sample.block {
        let at = Vector3::new(block.pose[0], block.pose[1], block.pose[2]);
        arrows.extend(arrow(at, Vector3::from(block.force) * FORCE_LENGTH, color(4, 1.0)));
    }
    let entity = SceneEntity {
        timestamp: timestamp(sample.time_s),
        frame_id: WORLD.to_owned(),
        id: "forces".to_owned(),
        arrows,
        ..SceneEntity::default()
    };
    SceneUpdate { deletions: Vec::new(), entities: vec![entity] }
}

/// Angles, rates and torques of all joints.
pub(super) fn joints(robot: &Robot, sample: &Sample) -> JointStates {
    let joint = |(i, name): (usize, &String)| JointState {
        name: name.clone(),
        position: Some(sample.positions[7 + i]),
        velocity: Some(sample.velocities[6 + i]),
        acceleration: None,
        effort: Some(sample.torques[i]),
    };
    JointStates {
        timestamp: timestamp(sample.time_s),
        joints: robot.joints.iter().enumerate().map(joint).collect(),
    }
}

/// An event as a line of a log.
pub(super) fn log(event: &Event) -> Log {
    Log {
        timestamp: timestamp(event.time_s),
        level: Level::Info as i32,
        message: format!("{} {}", event.place, event.kind),
        name: event.place.clone(),
        ..Log::default()
    }
}

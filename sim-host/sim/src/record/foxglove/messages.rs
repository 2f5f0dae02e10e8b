//! The messages of a sample.

use super::arrows::arrow;
use super::nanoseconds;
use crate::picture::OKABE_ITO;
use crate::picture::{DESIRED_FORCE_LENGTH, Moment, Shown, ShownBody, Solid, TORQUE_LENGTH};
use crate::record::{Event, JointReading};
use ::foxglove::messages::log::Level;
use ::foxglove::messages::{
    Color, FrameTransform, FrameTransforms, JointState, JointStates, Log, Point3, Quaternion,
    SceneEntity, SceneUpdate, Timestamp, TriangleListPrimitive, Vector3 as FoxgloveVector,
};
use nalgebra::{Rotation3, UnitQuaternion, Vector3};

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
pub(super) fn transforms(shown: &Shown, time_s: f64, moment: &Moment) -> FrameTransforms {
    let transform = |child: String, position: Vector3<f64>, rotation: Quaternion| FrameTransform {
        timestamp: timestamp(time_s),
        parent_frame_id: WORLD.to_owned(),
        child_frame_id: child,
        translation: Some(vector(position)),
        rotation: Some(rotation),
    };
    let mut transforms: Vec<FrameTransform> = shown
        .bodies
        .iter()
        .zip(&moment.poses)
        .map(|(body, pose)| {
            let rotation = Rotation3::from_matrix_unchecked(pose.rotation);
            let rotation = quaternion(&UnitQuaternion::from_rotation_matrix(&rotation));
            transform(frame(&body.name), pose.position, rotation)
        })
        .collect();
    if let Some(block) = &moment.block {
        let [x, y, z, w, i, j, k] = block.pose;
        let rotation = Quaternion { x: i, y: j, z: k, w };
        transforms.push(transform(BLOCK.to_owned(), Vector3::new(x, y, z), rotation));
    }
    FrameTransforms { transforms }
}

/// Solids that go with their frames, those that stand, and a ghost at the set point.
pub(super) fn solids(shown: &Shown, time_s: f64) -> SceneUpdate {
    const OF_GROUPS: [usize; 3] = [2, 5, 3];
    let of_body = |body: &ShownBody| {
        let color = color(OF_GROUPS[usize::from(body.group) % OF_GROUPS.len()], 1.0);
        entity(time_s, &frame(&body.name), &body.name, &body.solids, color)
    };
    let mut entities: Vec<SceneEntity> = shown.bodies.iter().map(of_body).collect();
    if let Some(block) = &shown.block {
        entities.push(entity(time_s, BLOCK, BLOCK, std::slice::from_ref(block), color(4, 1.0)));
    }
    if !shown.pivots.is_empty() {
        entities.push(entity(time_s, WORLD, "pivots", &shown.pivots, color(0, 0.5)));
    }
    if let Some(goal) = &shown.goal {
        let ghost = std::slice::from_ref(goal);
        entities.push(entity(time_s, WORLD, "set point", ghost, color(0, 0.15)));
    }
    SceneUpdate { deletions: Vec::new(), entities }
}

fn entity(time_s: f64, frame: &str, id: &str, solids: &[Solid], color: Color) -> SceneEntity {
    let of_solid = |solid: &Solid| {
        // A convex face is a fan of triangles.
        let fan = |face: &Vec<usize>| -> Vec<u32> {
            let pairs = face.windows(2).skip(1);
            pairs.flat_map(|pair| [face[0] as u32, pair[0] as u32, pair[1] as u32]).collect()
        };
        TriangleListPrimitive {
            points: solid.vertices.iter().map(|[x, y, z]| Point3 { x: *x, y: *y, z: *z }).collect(),
            color: Some(color),
            indices: solid.faces.iter().flat_map(fan).collect(),
            ..TriangleListPrimitive::default()
        }
    };
    SceneEntity {
        timestamp: timestamp(time_s),
        frame_id: frame.to_owned(),
        id: id.to_owned(),
        frame_locked: true,
        triangles: solids.iter().map(of_solid).collect(),
        ..SceneEntity::default()
    }
}

/// The forces of the ground and of the block, and the wrench that the controller asks for. Each message
/// replaces the one before, as the entity's name is the same.
pub(super) fn forces(shown: &Shown, time_s: f64, moment: &Moment) -> SceneUpdate {
    let mut arrows = Vec::new();
    for (point, force) in shown.points.iter().zip(&moment.forces) {
        let at = moment.poses[point.body].transform_point(point.at);
        arrows.extend(arrow(at, Vector3::from(*force) * shown.force_length, color(1, 1.0)));
    }
    if let (Some(body), Some(tracking)) = (moment.poses.first(), &moment.tracking) {
        let [fx, fy, fz, tx, ty, tz] = tracking.desired_wrench;
        let force = body.rotation * Vector3::new(fx, fy, fz) * DESIRED_FORCE_LENGTH;
        let torque = body.rotation * Vector3::new(tx, ty, tz) * TORQUE_LENGTH;
        arrows.extend(arrow(body.position, force, color(0, 1.0)));
        arrows.extend(arrow(body.position, torque, color(2, 1.0)));
    }
    if let Some(block) = &moment.block {
        let at = Vector3::new(block.pose[0], block.pose[1], block.pose[2]);
        arrows.extend(arrow(at, Vector3::from(block.force) * shown.force_length, color(4, 1.0)));
    }
    let entity = SceneEntity {
        timestamp: timestamp(time_s),
        frame_id: WORLD.to_owned(),
        id: "forces".to_owned(),
        arrows,
        ..SceneEntity::default()
    };
    SceneUpdate { deletions: Vec::new(), entities: vec![entity] }
}

/// Angles, rates and torques of all joints.
pub(super) fn joints(time_s: f64, readings: &[JointReading<'_>]) -> JointStates {
    let joint = |reading: &JointReading<'_>| JointState {
        name: reading.name.to_owned(),
        position: Some(reading.position),
        velocity: Some(reading.velocity),
        acceleration: None,
        effort: reading.effort,
    };
    JointStates { timestamp: timestamp(time_s), joints: readings.iter().map(joint).collect() }
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

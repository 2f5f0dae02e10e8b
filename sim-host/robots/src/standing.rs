//! Feet that nobody has named: the lowest links that hang from the root by joints enough for a leg.

use crate::description::{DescribedJoint, DescribedKind, Description};
use crate::feet::sole;
use nalgebra::Isometry3;

/// Joints of a leg at least: as many as a point has directions.
const LEG: usize = 3;
/// Soles that lie higher above the lowest than this part of the robot's height are hands.
const HANDS: f64 = 0.1;

/// Links that can be feet, in the file's order; none where there are fewer than two.
pub(crate) fn feet(description: &Description, root: usize) -> Vec<String> {
    let mut carriers: Vec<Option<usize>> = vec![None; description.links.len()];
    for (j, joint) in description.joints.iter().enumerate() {
        carriers[joint.child] = Some(j);
    }
    // Outboard first; the reader has made sure that joints make a tree.
    let path = |link: usize| -> Vec<&DescribedJoint> {
        let mut joints = Vec::new();
        let mut at = link;
        while let (true, Some(j)) = (at != root, carriers[at]) {
            joints.push(&description.joints[j]);
            at = description.joints[j].parent;
        }
        joints
    };
    let world = |link: usize| -> Isometry3<f64> {
        path(link).iter().rev().fold(Isometry3::identity(), |pose, joint| pose * joint.origin)
    };
    let is_moving = |joint: &&DescribedJoint| joint.kind != DescribedKind::Fixed;
    let moves = |kind| {
        use DescribedKind::{Continuous, Prismatic, Revolute};
        matches!(kind, Revolute | Continuous | Prismatic)
    };
    let carries_more = |last: &DescribedJoint| {
        let mut moving = description.joints.iter().filter(|joint| is_moving(joint));
        moving.any(|joint| path(joint.parent).iter().any(|inboard| inboard.name == last.name))
    };
    let mut heights = Vec::new();
    // Name of the last joint, link, height of its sole.
    let mut lowest: Vec<(String, usize, f64)> = Vec::new();
    for (k, link) in description.links.iter().enumerate() {
        let pose = world(k);
        heights.push(pose.translation.z);
        let joints = path(k);
        let moving: Vec<&DescribedJoint> = joints.into_iter().filter(is_moving).collect();
        let is_leg = moving.len() >= LEG && moving.iter().all(|joint| moves(joint.kind));
        let (true, Some(last)) = (is_leg && !link.shapes.is_empty(), moving.first()) else {
            continue;
        };
        let Ok(points) = sole(&link.shapes, &pose) else { continue };
        let height =
            |z: f64, p: &nalgebra::Vector3<f64>| z.min(pose.transform_point(&(*p).into()).z);
        let bottom = points.iter().fold(f64::INFINITY, height);
        heights.push(bottom);
        match lowest.iter_mut().find(|(name, ..)| *name == last.name) {
            Some((_, link, height)) if bottom < *height => (*link, *height) = (k, bottom),
            Some(_) => {}
            None if carries_more(last) => {}
            None => lowest.push((last.name.clone(), k, bottom)),
        }
    }
    let floor = heights.iter().copied().fold(f64::INFINITY, f64::min);
    let top = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    lowest.retain(|(_, _, bottom)| *bottom <= floor + HANDS * (top - floor));
    match lowest.len() {
        0 | 1 => Vec::new(),
        _ => lowest.into_iter().map(|(_, k, _)| description.links[k].name.clone()).collect(),
    }
}

//! Where a joint's axis is.

use crate::Real;
use crate::model::{Axis, JointKind, Node};
use crate::spatial::Pose;
use nalgebra::Vector3;

/// The axis of a joint with one degree of freedom.
#[derive(Clone, Copy, Debug)]
pub(crate) struct JointLine<T> {
    /// Unit vector, in the sense in which the coordinate counts.
    pub along: Vector3<T>,
    /// A point on it, m; `None` for a joint that slides.
    pub point: Option<Vector3<T>>,
}

/// From the pose of the joint's body, in whatever frame that is given; `None` for other joints.
#[inline(always)]
pub(crate) fn joint_line<T: Real>(node: &Node<T>, pose: &Pose<T>) -> Option<JointLine<T>> {
    let axes = match &node.body_rotation {
        None => pose.rotation,
        Some(r) => pose.rotation * r.transpose(),
    };
    let (axis, slides) = match node.kind {
        JointKind::Revolute(axis) => (axis, false),
        JointKind::Prismatic(axis) => (axis, true),
        _ => return None,
    };
    let along: Vector3<T> = match axis {
        Axis::X => axes.column(0).into(),
        Axis::Y => axes.column(1).into(),
        Axis::Z => axes.column(2).into(),
    };
    let along = if node.is_reversed { -along } else { along };
    let point = (!slides).then(|| pose.position - axes * node.center);
    Some(JointLine { along, point })
}

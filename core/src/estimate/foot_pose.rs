//! Where feet are in the central body's frame, by encoders: what a step is fed.
//!
//! # Notation
//! Of a joint, in its inboard frame: `d` where its frame is at home, `H` how that is turned, `T(θ)` what it
//! does; `c, B` centre of mass and axes of the foot's body in its joint's frame; `s, Z` of a point and axes in
//! that body.
//! ```text
//! p = c + B s,  A = B Z;   from the foot to the hip:  p ← d + H T p,  A ← H T A         (1)
//! ```

use super::FootKind;
use crate::Real;
use crate::balance::WholeBodyFoot;
use crate::model::{Axis, JointKind, Node, Tree};
use crate::spatial::{AxisTurn, Quaternion, Rotation};
use nalgebra::{Matrix3, Vector3};

/// A foot in the central body's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FootPose<T> {
    /// Its reference point from the central body's centre of mass, m.
    pub position: Vector3<T>,
    /// Central body from sole, unit quaternion.
    pub orientation: Quaternion<T>,
}

/// (1) for all feet of a tree whose body 0 is the central one, at coordinates of which the first seven are not
/// read; absent feet are at the origin. Numbers that are not finite go through, for the step to refuse.
///
/// # Cost
/// About 45 multiplications, a sine and a cosine for each joint between foot and central body.
pub fn foot_poses<T: Real, const N: usize, const NQ: usize, const NV: usize, const FEET: usize>(
    tree: &Tree<T, N, NQ, NV>,
    feet: &[Option<WholeBodyFoot<T>>; FEET],
    positions: &[T; NQ],
) -> [FootPose<T>; FEET] {
    let nowhere = FootPose { position: Vector3::zeros(), orientation: Quaternion::identity() };
    let mut poses = [nowhere; FEET];
    for (pose, foot) in poses.iter_mut().zip(feet) {
        if let Some(foot) = foot {
            *pose = foot_pose(&tree.nodes, positions, foot);
        }
    }
    poses
}

impl FootKind {
    /// By what the ground can do to it: an edge turns about itself, so that its middle is what stands still.
    pub fn of<T: Real>(foot: &WholeBodyFoot<T>) -> Self {
        match foot.limits.patch.moments() {
            [true, true, true] => Self::Sole,
            _ => Self::Point,
        }
    }
}

/// (1) for one.
fn foot_pose<T: Real>(nodes: &[Node<T>], positions: &[T], foot: &WholeBodyFoot<T>) -> FootPose<T> {
    let (mut position, mut axes) = (foot.reference, Matrix3::identity());
    let mut at = nodes.get(foot.body);
    if let Some(node) = at {
        if let Some(body) = &node.body_rotation {
            (position, axes) = (body * position, *body);
        }
        position += node.center;
    }
    // Numbers decrease on the way inboard.
    while let Some((node, inboard)) = at.and_then(|node| Some((node, node.inboard?))) {
        let own = positions.get(node.position_start).copied().unwrap_or(T::zero());
        let own = if node.is_reversed { -own } else { own };
        let rotation = match &node.kind {
            JointKind::Revolute(axis) => {
                let turn = AxisTurn::new(own);
                match axis {
                    Axis::X => Rotation::X(turn),
                    Axis::Y => Rotation::Y(turn),
                    Axis::Z => Rotation::Z(turn),
                }
            }
            JointKind::Prismatic(axis) => {
                match axis {
                    Axis::X => position.x += own,
                    Axis::Y => position.y += own,
                    Axis::Z => position.z += own,
                }
                Rotation::Identity
            }
            // Controllers of whole bodies have no others.
            _ => Rotation::Identity,
        };
        position = rotation.inboard(position);
        axes = turned(&rotation, &axes);
        if let Some(home) = &node.home_rotation {
            (position, axes) = (home * position, home * axes);
        }
        position += node.offset;
        at = nodes.get(inboard);
    }
    FootPose { position, orientation: Quaternion::from_matrix(&axes).product(foot.axes) }
}

/// `R A`.
fn turned<T: Real>(rotation: &Rotation<T>, axes: &Matrix3<T>) -> Matrix3<T> {
    let column = |k: usize| rotation.inboard(axes.column(k).into());
    Matrix3::from_columns(&[column(0), column(1), column(2)])
}

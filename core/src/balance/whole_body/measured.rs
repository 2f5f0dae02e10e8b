//! What a tick makes of its inputs before the dynamics: checks, the posture's accelerations, joint axes.

use super::joint_line::{JointLine, joint_line};
use super::motion::kept;
use super::robot::WholeBody;
use super::{WholeBodySettings, WholeBodyState};
use crate::Real;
use crate::balance::leg_kinematics::unit;
use crate::balance::tick::check_reference;
use crate::balance::{CentralBody, Fault, Input, Reference};
use crate::dynamics::Kinematics;
use crate::model::Tree;
use crate::spatial::{Quaternion, Twist};
use nalgebra::{Matrix3, Vector3};

/// What a joint does that is free to.
#[inline(always)]
pub(super) fn posture<T: Real, const FEET: usize, const NQ: usize, const NV: usize>(
    robot: &WholeBody<T, FEET, NV>,
    settings: &WholeBodySettings<T, NV>,
    state: &WholeBodyState<T, NQ, NV>,
) -> [T; NV] {
    let [stiffness, damping] = settings.posture_gains;
    let mut accelerations = [T::zero(); NV];
    let all = robot.joints.iter().zip(&settings.posture).zip(&state.velocities);
    for (to, ((joint, wanted), rate)) in accelerations.iter_mut().zip(all) {
        let angle = joint.and_then(|joint| state.positions.get(joint.coordinate));
        if let Some(angle) = angle {
            *to = (*wanted - *angle) * stiffness - *rate * damping;
        }
    }
    if let Some(ranges) = &settings.ranges {
        let all = robot.joints.iter().zip(ranges).zip(&state.velocities);
        for (to, ((joint, range), rate)) in accelerations.iter_mut().zip(all) {
            let angle = joint.and_then(|joint| state.positions.get(joint.coordinate));
            if let Some(angle) = angle {
                *to = kept(*range, settings.range_rate, (*angle, *rate), *to);
            }
        }
    }
    accelerations
}

/// Twist at frame 1's origin per rate of each joint that moves a foot, frame 1's axes.
#[inline(always)]
pub(super) fn screws<
    T: Real,
    const N: usize,
    const NQ: usize,
    const NV: usize,
    const FEET: usize,
>(
    tree: &Tree<T, N, NQ, NV>,
    robot: &WholeBody<T, FEET, NV>,
    kinematics: &Kinematics<T, N>,
    central: &Matrix3<T>,
) -> [Twist<T>; NV] {
    let mut screws = [Twist::zero(); NV];
    for (screw, joint) in screws.iter_mut().zip(&robot.joints) {
        let Some(joint) = joint.as_ref().filter(|joint| joint.feet != 0) else { continue };
        let (Some(node), Some(body)) = (tree.nodes.get(joint.node), kinematics.get(joint.node))
        else {
            continue;
        };
        let Some(JointLine { along, point }) = joint_line(node, &body.pose) else { continue };
        let along = central.tr_mul(&along);
        *screw = match point {
            None => Twist { linear: along, angular: Vector3::zeros() },
            Some(point) => Twist { linear: central.tr_mul(&point).cross(&along), angular: along },
        };
    }
    screws
}

/// Alg. 4.1, of inputs that can be.
#[inline(always)]
pub(super) fn checked<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    state: &WholeBodyState<T, NQ, NV>,
    reference: &Reference<T>,
) -> Result<CentralBody<T>, Fault> {
    check_finite(state)?;
    check_reference(reference)?;
    central_body(tree, state)
}

/// The same without a reference.
#[inline(always)]
pub(super) fn checked_state<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    state: &WholeBodyState<T, NQ, NV>,
) -> Result<CentralBody<T>, Fault> {
    check_finite(state)?;
    central_body(tree, state)
}

#[inline(always)]
fn check_finite<T: Real, const NQ: usize, const NV: usize>(
    state: &WholeBodyState<T, NQ, NV>,
) -> Result<(), Fault> {
    let WholeBodyState { positions, velocities } = state;
    for (k, x) in positions.iter().enumerate() {
        if !x.is_finite() {
            return Err(Fault::NotFinite(match k {
                0..3 => Input::Position,
                3..7 => Input::Orientation,
                _ => Input::Coordinate(k),
            }));
        }
    }
    for (k, x) in velocities.iter().enumerate() {
        if !x.is_finite() {
            let input = if k < 6 { Input::Velocity } else { Input::Rate(k) };
            return Err(Fault::NotFinite(input));
        }
    }
    Ok(())
}

#[inline(always)]
fn central_body<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    state: &WholeBodyState<T, NQ, NV>,
) -> Result<CentralBody<T>, Fault> {
    let WholeBodyState { positions, velocities } = state;
    let mut q = [T::zero(); 4];
    for (to, x) in q.iter_mut().zip(positions.iter().skip(3)) {
        *to = *x;
    }
    let orientation = unit(Quaternion::from_array(q)).ok_or(Fault::NotUnit(Input::Orientation))?;
    let rotation = orientation.to_matrix();
    let mut v = [T::zero(); 6];
    for (to, x) in v.iter_mut().zip(velocities) {
        *to = *x;
    }
    let velocity = Twist::from_array(v);
    let gravity = rotation.tr_mul(&tree.gravity);
    Ok(CentralBody { rotation, orientation, velocity, gravity })
}

pub(super) fn first3<T: Real, const NQ: usize>(positions: &[T; NQ]) -> Vector3<T> {
    match positions.first_chunk() {
        Some([x, y, z]) => Vector3::new(*x, *y, *z),
        None => Vector3::zeros(),
    }
}

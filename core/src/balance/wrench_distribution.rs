//! Algorithm 4.5: the desired wrench as a sum of foot wrenches of least norm, without limits.
//!
//! The printed norm adds squared newtons to squared newton-metres; it is kept.
//! [`contact_wrenches`](super::contact_wrenches) has limits and a norm.

use super::LegKinematics;
use super::least_norm::LeastNorm;
use crate::Real;
use crate::spatial::{SymmetricMatrix3, Wrench};
use nalgebra::Vector3;

/// The wrenches asked of the feet, from [`wrench_distribution`].
#[derive(Clone, Copy, Debug)]
pub struct FootWrenches<T, const LEGS: usize> {
    /// On each foot from the ground, at the foot's centre of mass, in frame 1's axes.
    pub in_central_axes: [Wrench<T>; LEGS],
    /// `F_l`, `F_r`: the same in the feet's body frames.
    pub in_foot_frames: [Wrench<T>; LEGS],
}

/// Alg. 4.5 for the wrench `desired` on the central body, in its frame. `None` where the feet are so
/// far away that numbers overflow.
#[inline(always)]
pub fn wrench_distribution<T: Real, const LEGS: usize>(
    desired: Wrench<T>,
    legs: &[LegKinematics<T>; LEGS],
) -> Option<FootWrenches<T, LEGS>> {
    let positions = legs.each_ref().map(|leg| Some(leg.foot.position));
    Some(in_foot_frames(split(desired, positions)?, legs))
}

/// The same over feet at these positions, in frame 1's axes; those that are `None` take no part.
#[inline(always)]
pub(super) fn split<T: Real, const LEGS: usize>(
    desired: Wrench<T>,
    positions: [Option<Vector3<T>>; LEGS],
) -> Option<[Wrench<T>; LEGS]> {
    let count = positions.iter().flatten().count();
    let split = LeastNorm::new(positions, SymmetricMatrix3::scalar(T::of(count as f64)))?;
    let (torque, forces) = split.forces(desired);
    Some(forces.map(|force| force.map_or(Wrench::zero(), |force| Wrench { force, torque })))
}

/// With what they are in the feet's body frames.
#[inline(always)]
pub(super) fn in_foot_frames<T: Real, const LEGS: usize>(
    in_central_axes: [Wrench<T>; LEGS],
    legs: &[LegKinematics<T>; LEGS],
) -> FootWrenches<T, LEGS> {
    let mut in_foot_frames = in_central_axes;
    for (wrench, leg) in in_foot_frames.iter_mut().zip(legs) {
        *wrench = Wrench {
            force: leg.foot.rotation.tr_mul(&wrench.force),
            torque: leg.foot.rotation.tr_mul(&wrench.torque),
        };
    }
    FootWrenches { in_central_axes, in_foot_frames }
}

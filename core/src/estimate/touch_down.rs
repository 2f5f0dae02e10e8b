//! (6): a foot's position and orientation anew, from the body's.

use super::covariance::{FOOT_ORIENTATION, FOOT_POSITION, POSITION, TILT};
use super::predict::widen;
use super::update::mirror;
use super::{Estimator, EstimatorState, FootKind, FootReading};
use crate::Real;
use nalgebra::{Matrix3, Vector3};

/// Foot `number` has touched down, its reference point at `s` from the inertial sensor. Errors that this tick's
/// measurements have found so far must be zero: it comes before all of them.
#[inline(always)]
pub(super) fn touch_down<T: Real, const FEET: usize>(
    settings: &Estimator<T, FEET>,
    state: &mut EstimatorState<T, FEET>,
    number: usize,
    (kind, reading, s): (FootKind, &FootReading<T>, Vector3<T>),
    rotation: &Matrix3<T>,
) {
    let Some(foot) = state.feet.get_mut(number) else { return };
    foot.position = state.position + rotation * s;
    foot.is_known = true;
    // P_jr + P_jθ Cᵀ with C = −R [s], so Cᵀ = [s] Rᵀ.
    let arm = s.cross_matrix() * rotation.transpose();
    let r = state.covariance.column::<POSITION>();
    let tilt = state.covariance.column::<TILT>();
    let noise = &settings.noise;
    let mut column = r;
    for (to, tilt) in column.body.iter_mut().zip(&tilt.body) {
        *to += tilt * arm;
    }
    for (to, tilt) in column.feet.as_flattened_mut().iter_mut().zip(tilt.feet.as_flattened()) {
        *to += tilt * arm;
    }
    // Its own: (P_rp)ᵀ's form of the same sum.
    let mut own = column.body[POSITION] + arm.tr_mul(&column.body[TILT]);
    mirror(&mut own);
    widen(&mut own, noise.leg_position * noise.leg_position);
    if let Some(to) = column.feet.get_mut(number) {
        to[FOOT_POSITION] = own;
    }
    state.covariance.set_foot_column((number, FOOT_POSITION), &column);
    if kind == FootKind::Point {
        return;
    }
    foot.orientation = state.orientation.product(reading.orientation);
    let back = rotation.transpose();
    let turned = |block: &Matrix3<T>| block * back;
    let mut column = tilt;
    column.body = tilt.body.each_ref().map(turned);
    column.feet = tilt.feet.each_ref().map(|parts| parts.each_ref().map(turned));
    // P_pφ, from the position's new row.
    let position = r.body[TILT].transpose();
    let with_position = position + arm.tr_mul(&tilt.body[TILT]);
    let mut own = rotation * column.body[TILT];
    mirror(&mut own);
    widen(&mut own, noise.leg_orientation * noise.leg_orientation);
    if let Some(to) = column.feet.get_mut(number) {
        to[FOOT_POSITION] = with_position * back;
        to[FOOT_ORIENTATION] = own;
    }
    state.covariance.set_foot_column((number, FOOT_ORIENTATION), &column);
}

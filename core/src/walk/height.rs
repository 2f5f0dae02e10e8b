//! How high the centre of mass is carried.
//!
//! ```text
//! z* = z − max(0, h_0 − √((λ L)² − r²))        r = 0.6 |u|                                    (1)
//! ```
//! `h_0` is the height of the hips, `L` a straight leg, `λ` the share to which it may stretch, `r` how far the
//! trailing foot is behind the hip when it leaves: for a long step the robot walks lower, and no knee goes
//! through straight.

use super::{Gait, Stature};
use crate::Real;
use nalgebra::Vector2;

/// Share of a step by which a trailing foot is behind the hip.
const TRAILING: f64 = 0.6;
/// Hips are never asked below this share of the straight leg.
const LEAST: f64 = 0.5;

/// (1) for the commanded `velocity` (m/s), or for the longer `step` (less the step in place, m); at least `lowered`
/// (m) below the standing height.
pub(super) fn carried<T: Real, const FEET: usize>(
    gait: &Gait<T>,
    stature: &Stature<T, FEET>,
    velocity: Vector2<T>,
    step: Vector2<T>,
    lowered: T,
) -> T {
    let usual = velocity.norm() * (gait.single + gait.double);
    let behind = usual.max(step.norm()) * T::of(TRAILING);
    let length = stature.robot.leg_length;
    let stretched = length * gait.straight;
    let least = length * T::of(LEAST);
    let hips = (stretched * stretched - behind * behind).max(least * least).sqrt();
    stature.height - (stature.hip_height - hips).max(lowered).max(T::zero())
}

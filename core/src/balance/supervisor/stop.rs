//! The stop: motors brake, `τ = −d θ̇`, and never drive.
//!
//! A rate that brakes is one on which a joint's two readings agree: of the measured rate and of the
//! angle's displacement since the measurement before, over the time, the smaller where both have the
//! same sign, and zero where they have not. So one reading that is wrong makes no torque that drives, and
//! a joint of which nothing is known is limp.

use super::Before;
use super::limits::{JointDamping, JointLimits};
use crate::Real;
use crate::balance::RobotState;
use crate::balance::robot::LEG;

/// `d` of a joint for torques held over `period`: half of what takes all of its least inertia's motion.
#[inline(always)]
pub(super) fn held_damping<T: Real>(joint: &JointDamping<T>, period: T) -> T {
    let most = joint.inertia * T::of(0.5) / period;
    if joint.damping > most { most } else { joint.damping }
}

/// Torques that brake, `share` of them, within limits; zero for the `blamed` joint.
#[inline(always)]
pub(super) fn braking<T: Real, const LEGS: usize>(
    damping: &[[T; LEG]; LEGS],
    limits: &[[JointLimits<T>; LEG]; LEGS],
    (before, h): (&Before<T, LEGS>, T),
    now: &RobotState<T, LEGS>,
    share: T,
    blamed: Option<(usize, usize)>,
) -> [[T; LEG]; LEGS] {
    let mut torques = [[T::zero(); LEG]; LEGS];
    let per_second = T::one() / h;
    let legs = now.joint_angles.iter().zip(&now.joint_rates).zip(&before.state.joint_angles);
    let legs = legs.zip(damping.iter().zip(limits)).zip(&mut torques).enumerate();
    for (leg, ((((angles, rates), old_angles), (damping, limits)), torques)) in legs {
        let joints = angles.iter().zip(rates).zip(old_angles);
        let joints = joints.zip(damping.iter().zip(limits)).zip(torques).enumerate();
        for (joint, ((((angle, rate), old_angle), (damping, limits)), torque)) in joints {
            let moved = (*angle - *old_angle) * per_second;
            let speed = if moved.abs() < rate.abs() { moved } else { *rate };
            let wanted = -*damping * share * speed;
            // Not where one is NaN.
            if moved * *rate > T::zero() && blamed != Some((leg, joint)) {
                *torque = within(wanted, limits.torque);
            }
        }
    }
    torques
}

/// The nearest torque within `±limit`.
#[inline(always)]
pub(super) fn within<T: Real>(torque: T, limit: T) -> T {
    if torque > limit {
        limit
    } else if torque < -limit {
        -limit
    } else {
        torque
    }
}

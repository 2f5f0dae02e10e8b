//! Whether a measurement can be: by itself, and after the one before it.
//!
//! # Notation
//! For each joint, and for the central body with its world position `p`, orientation `q`, velocity `v`
//! and angular velocity `Ω` (body axes); `'` is the measurement before, `h` seconds ago.
//!
//! ```text
//! e_θ = θ − θ' − h (ω + ω')/2                                                                (1)
//! e_p = p − p' − h (v + v')/2                                                                (2)
//! e_q = 2 vec(q'* ⋆ q) − h (Ω + Ω')/2        with the sign of q for which this is short       (3)
//! u_θ = |e_θ| − h |ω − ω'|/2                                                                 (4)
//! ```
//! (4) is what no single step of the rate within the tick explains. An impact makes residuals (1) and
//! leaves (4) at zero, but for a joint that is struck twice; a reading that stands still while the joint
//! moves, or moves while it stands still, has `u_θ = h |ω|` at every tick.

use super::limits::{JointLimits, Thresholds};
use super::{Before, StopReason};
use crate::Real;
use crate::balance::robot::LEG;
use crate::balance::{Input, RobotState};
use nalgebra::Vector3;

/// What the joints' residuals say.
pub(super) struct Joints<const LEGS: usize> {
    pub is_doubtful: bool,
    pub unexplained: [u8; LEGS],
}

/// Angles and rates within what encoders can read.
///
/// # Errors
/// [`StopReason::Encoder`]: NaN and infinity end here too, with the joint's number.
#[inline(always)]
pub(super) fn in_range<T: Real, const LEGS: usize>(
    limits: &[[JointLimits<T>; LEG]; LEGS],
    now: &RobotState<T, LEGS>,
) -> Result<(), StopReason> {
    let legs = now.joint_angles.iter().zip(&now.joint_rates).zip(limits).enumerate();
    for (leg, ((angles, rates), limits)) in legs {
        for (joint, ((angle, rate), limits)) in angles.iter().zip(rates).zip(limits).enumerate() {
            let [least, greatest] = limits.angle;
            let inside = (*angle - least) * (greatest - *angle);
            if !(inside >= T::zero() && rate.abs() <= limits.rate) {
                return Err(StopReason::Encoder { leg, joint });
            }
        }
    }
    Ok(())
}

/// (1) and (4) of all joints.
///
/// # Errors
/// [`StopReason::Jump`] and [`StopReason::Frozen`].
#[inline(always)]
pub(super) fn joints<T: Real, const LEGS: usize>(
    thresholds: &Thresholds<T>,
    before: &Before<T, LEGS>,
    now: &RobotState<T, LEGS>,
    h: T,
) -> Result<Joints<LEGS>, StopReason> {
    let half = h * T::of(0.5);
    let doubtful = thresholds.angle_noise + half * thresholds.rate_step;
    let mut found = Joints { is_doubtful: false, unexplained: [0; LEGS] };
    let mut largest = T::zero();
    let legs = now.joint_angles.iter().zip(&now.joint_rates);
    let legs = legs.zip(before.state.joint_angles.iter().zip(&before.state.joint_rates));
    let legs = legs.zip(found.unexplained.iter_mut().zip(&before.unexplained)).enumerate();
    for (leg, (((angles, rates), (old_angles, old_rates)), (unexplained, earlier))) in legs {
        let joints = angles.iter().zip(rates).zip(old_angles.iter().zip(old_rates));
        for (joint, ((angle, rate), (old_angle, old_rate))) in joints.enumerate() {
            let residual = (*angle - *old_angle - half * (*rate + *old_rate)).abs();
            if residual > largest {
                largest = residual;
            }
            let step = half * (*rate - *old_rate).abs();
            if residual - step > thresholds.frozen_angle {
                *unexplained |= 1 << joint;
            }
        }
        let always = earlier.iter().fold(*unexplained, |all, bits| all & bits);
        if always != 0 {
            return Err(StopReason::Frozen { leg, joint: always.trailing_zeros() as usize });
        }
    }
    if largest > doubtful * thresholds.gross {
        return Err(jump(before, now, half, largest));
    }
    found.is_doubtful = largest > doubtful;
    Ok(found)
}

/// (2) and (3): whether they are doubtful. Of numbers that are not finite the tick says which they are.
///
/// # Errors
/// [`StopReason::BodyJump`].
#[inline(always)]
pub(super) fn body<T: Real, const LEGS: usize>(
    thresholds: &Thresholds<T>,
    before: &Before<T, LEGS>,
    now: &RobotState<T, LEGS>,
    velocity: Vector3<T>,
    h: T,
) -> Result<bool, StopReason> {
    let half = h * T::of(0.5);
    let moved = now.position - before.state.position;
    let position = (moved - (velocity + before.velocity) * half).norm_squared();
    let turned = before.state.orientation.conjugate().product(now.orientation);
    let two = if turned.s < T::zero() { T::of(-2.0) } else { T::of(2.0) };
    let rates = now.velocity.angular + before.state.velocity.angular;
    let orientation = (turned.v * two - rates * half).norm_squared();
    let mut is_doubtful = false;
    for (squared, step, input) in [
        (position, thresholds.velocity_step, Input::Position),
        (orientation, thresholds.angular_velocity_step, Input::Orientation),
    ] {
        let doubtful = half * step;
        let gross = doubtful * thresholds.gross;
        if squared > gross * gross && is_finite(now) {
            return Err(StopReason::BodyJump(input));
        }
        is_doubtful |= squared > doubtful * doubtful;
    }
    Ok(is_doubtful)
}

/// The joint whose residual is the largest.
#[cold]
fn jump<T: Real, const LEGS: usize>(
    before: &Before<T, LEGS>,
    now: &RobotState<T, LEGS>,
    half: T,
    largest: T,
) -> StopReason {
    let (old_angles, old_rates) = (&before.state.joint_angles, &before.state.joint_rates);
    for leg in 0..LEGS {
        for joint in 0..LEG {
            let of = |all: &[[T; LEG]; LEGS]| all.get(leg)?.get(joint).copied();
            let all = of(&now.joint_angles).zip(of(&now.joint_rates));
            let old = of(old_angles).zip(of(old_rates));
            if let Some(((angle, rate), (old_angle, old_rate))) = all.zip(old)
                && (angle - old_angle - half * (rate + old_rate)).abs() >= largest
            {
                return StopReason::Jump { leg, joint };
            }
        }
    }
    StopReason::Doubtful
}

/// Whether all that is measured of the central body is a number.
#[cold]
fn is_finite<T: Real, const LEGS: usize>(now: &RobotState<T, LEGS>) -> bool {
    now.position.iter().all(|x| x.is_finite())
        && now.orientation.to_array().iter().all(|x| x.is_finite())
        && now.velocity.is_finite()
}

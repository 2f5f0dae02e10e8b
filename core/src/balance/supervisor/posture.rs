//! Whether the robot can still be caught.
//!
//! # Notation
//! - `r` last row of the central body's rotation matrix: the world's vertical in its axes; `r₃` is the
//!   cosine of its tilt, and `ṙ₃ = r₁ Ω_y − r₂ Ω_x`
//! - `z, v_z` height and its rate; `T` [`Thresholds::look_ahead_s`], zero while a leap is expected: who takes off turns
//!   faster than he will, and who lands sinks faster
//!
//! ```text
//! r₃ + T min(0, ṙ₃) ≥ c                                                                      (1)
//! z + T min(0, v_z) ≥ min(z_d, max z) − d                                                    (2)
//! ```

use super::StopReason;
use super::limits::Thresholds;
use crate::Real;
use crate::balance::RobotState;
use crate::spatial::Quaternion;

/// (1): comparisons with NaN are false, and are no tilt: of such numbers the tick says which they are.
///
/// # Errors
/// [`StopReason::Tilt`].
#[inline(always)]
pub(super) fn tilt<T: Real, const LEGS: usize>(
    thresholds: &Thresholds<T>,
    look_ahead: T,
    now: &RobotState<T, LEGS>,
) -> Result<(), StopReason> {
    let [r1, r2, r3] = vertical(&now.orientation);
    let omega = &now.velocity.angular;
    let falling = below_zero(r1 * omega.y - r2 * omega.x);
    if r3 + look_ahead * falling < thresholds.least_upright {
        return Err(StopReason::Tilt);
    }
    Ok(())
}

/// (2), where `highest` is `min(z_d, max z)` before this tick.
///
/// # Returns
/// The same after it.
///
/// # Errors
/// [`StopReason::Height`].
#[inline(always)]
pub(super) fn height<T: Real>(
    thresholds: &Thresholds<T>,
    look_ahead: T,
    highest: Option<T>,
    wanted: T,
    [height, rate]: [T; 2],
) -> Result<T, StopReason> {
    let highest = match highest {
        Some(highest) if highest > height => highest,
        _ => height,
    };
    let highest = if highest > wanted { wanted } else { highest };
    if height + look_ahead * below_zero(rate) < highest - thresholds.drop {
        return Err(StopReason::Height);
    }
    Ok(highest)
}

#[inline(always)]
fn below_zero<T: Real>(x: T) -> T {
    if x < T::zero() { x } else { T::zero() }
}

#[inline(always)]
fn vertical<T: Real>(q: &Quaternion<T>) -> [T; 3] {
    let two = T::of(2.0);
    let (s, x, y, z) = (q.s, q.v.x, q.v.y, q.v.z);
    [two * (x * z - s * y), two * (y * z + s * x), T::one() - two * (x * x + y * y)]
}

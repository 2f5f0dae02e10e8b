//! Where the ground is to press.
//!
//! A capture point runs from the centre of pressure, `ξ' = ω (ξ − p)`; a centre of pressure beyond it brings it
//! back. With the course `ξ_n(t)` that the plan wants:
//!
//! ```text
//! p* = p + (1 + k) (ξ − ξ_n)                                                              (1)
//! ξ_n = a* exp(−ω t)                   on one side, t before touch-down; p in its point    (2)
//! ξ_n = p + p'/ω + (b − p'/ω) exp(−ω t)   on both, t before lift-off; b from the new point,
//!                                         p on its way there at the rate p'               (3)
//! ```
//! (3) is Englsberger's (section V) for a centre of pressure that moves at a constant rate; `a*` is what the chosen
//! step wants, so that (1) leaves the stance point only where no step in reach does all.

use super::bounded::bounded;
use super::seen::Seen;
use super::{Gait, PeriodicStep, PlannedStep, Side};
use crate::Real;
use nalgebra::{Vector2, Vector3};

/// Standing: how far the centre of pressure goes beyond the capture point, of its way to rest.
const STANDING_FEEDBACK: f64 = 2.0;

/// Horizontal acceleration of the centre of mass that brings the capture point to rest over `rest` (world, m): the
/// centre of pressure twice as far beyond it as it is beyond its rest.
pub(super) fn rest<T: Real, const FEET: usize>(
    gait: &Gait<T>,
    seen: &Seen<'_, T, FEET>,
    rest: Vector2<T>,
) -> Vector2<T> {
    let pressure = seen.xi + (seen.xi - rest) * T::of(STANDING_FEEDBACK);
    let squared = gait.omega * gait.omega;
    (seen.observed.center_of_mass.xy() - pressure) * squared
}

/// (1) and (2), within what the stance side can press on; world.
pub(super) fn single<T: Real, const FEET: usize>(
    gait: &Gait<T>,
    seen: &Seen<'_, T, FEET>,
    side: Side,
    periodic: &PeriodicStep<T>,
    step: &PlannedStep<T>,
) -> Vector2<T> {
    let wanted = periodic.touch_down_for(step.step) * (-gait.omega * step.left).exp();
    let shift = (seen.offset(side) - wanted) * (T::one() + gait.feedback);
    seen.point(side) + seen.heading.to_world(pressed(gait, seen, side, shift))
}

/// Double support, from one point to the next.
#[derive(Clone, Copy)]
pub(super) struct Transfer<T> {
    /// Old stance point, world.
    pub old: Vector2<T>,
    /// New one.
    pub new: Vector2<T>,
    /// Since touch-down, s.
    pub elapsed: T,
}

/// (1) and (3); world.
pub(super) fn double<T: Real, const FEET: usize>(
    gait: &Gait<T>,
    seen: &Seen<'_, T, FEET>,
    periodic: &PeriodicStep<T>,
    transfer: &Transfer<T>,
) -> Vector2<T> {
    let Transfer { old, new, elapsed } = *transfer;
    let share = (elapsed / gait.double).min(T::one());
    let left = (gait.double - elapsed).max(T::zero());
    let p = old + (new - old) * share;
    let ahead = p + (new - old) / (gait.double * gait.omega);
    let end = new + seen.heading.to_world(periodic.at_lift_off);
    let nominal = ahead + (end - ahead) * (-gait.omega * left).exp();
    p + (seen.xi - nominal) * (T::one() + gait.feedback)
}

/// The nearest shift of pressure from a side's point that its contact can make, heading frame: within a share
/// of the sole, on the line between two points, in the point.
fn pressed<T: Real, const FEET: usize>(
    gait: &Gait<T>,
    seen: &Seen<'_, T, FEET>,
    side: Side,
    shift: Vector2<T>,
) -> Vector2<T> {
    if !seen.stature.is_on_points() {
        let most = seen.stature.robot.pressure_reach * gait.margin;
        return shift.zip_map(&most, |x, most| bounded(x, -most, most));
    }
    let mut feet = seen.of_side(side).map(|foot| foot.position.xy());
    let (Some(first), Some(second)) = (feet.next(), feet.next()) else { return Vector2::zeros() };
    let half = seen.heading.of_world(first - second) * T::of(0.5);
    let squared = half.norm_squared();
    if !(squared > T::zero()) {
        return Vector2::zeros();
    }
    half * bounded(shift.dot(&half) / squared, -gait.margin, gait.margin)
}

/// How far the capture point lies beyond the rectangle around all soles along the heading axes, m; negative
/// inside.
pub(super) fn beyond<T: Real, const FEET: usize>(seen: &Seen<'_, T, FEET>) -> T {
    let e = seen.heading.of_world(seen.xi);
    let half = seen.stature.robot.sole;
    let mut farthest: Option<(Vector2<T>, Vector2<T>)> = None;
    for (_, _, foot) in seen.feet() {
        for (along, across) in
            [(half.x, half.y), (half.x, -half.y), (-half.x, half.y), (-half.x, -half.y)]
        {
            let corner = foot.position + foot.rotation * Vector3::new(along, across, T::zero());
            let corner = seen.heading.of_world(corner.xy());
            farthest = Some(farthest.map_or((corner, corner), |(least, most)| {
                (
                    Vector2::new(least.x.min(corner.x), least.y.min(corner.y)),
                    Vector2::new(most.x.max(corner.x), most.y.max(corner.y)),
                )
            }));
        }
    }
    let Some((least, most)) = farthest else { return T::zero() };
    let (before, behind) = (e - most, least - e);
    before.x.max(before.y).max(behind.x).max(behind.y)
}

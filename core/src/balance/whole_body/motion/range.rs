//! Joints kept within their ranges: bounds on the accelerations of legs' joints.
//!
//! # Notation
//! Beside that of the module above: `θ` in `[l, h]` the angle of a leg's joint, `r` the rate at which it may approach
//! an end.
//! ```text
//! r² (l − θ) − 2 r θ̇  ≤  θ̈  ≤  r² (h − θ) − 2 r θ̇                                            (1)
//! θ̈_k = θ̈₁,k − (J⁺ J_b)_k · X + (J⁺ d)_k                 (1) of the module, of a leg that swings too (2)
//! ```
//! With equality in (1) an angle comes to its end as a critically damped spring to rest, and not beyond. Rows are (1)
//! times an inertia, so that they give way as torques do.
//!
//! # Source
//! Barrier functions of second order as bounds on accelerations: Ames et al., "Control barrier functions: theory and
//! applications", ECC 2019, section V.

use super::super::robot::MOST_LEG_JOINTS;
use super::super::{WholeBody, WholeBodySettings, WholeBodyState};
use super::dynamics::{MotionDynamics, Moved, Unknowns};
use crate::Real;

/// Inertia of (1), of the mass of the whole at the square of a leg's reach.
const INERTIA: f64 = 0.01;

/// (1) by foot and joint of its leg, foot to hip, less `θ̈₁`: so of the last part of (2).
#[derive(Clone, Copy, Debug)]
pub(super) struct Ranges<T, const FEET: usize> {
    bounds: [[[T; 2]; MOST_LEG_JOINTS]; FEET],
    inertia: [T; FEET],
}

/// (1); `accelerations` are `θ̈₁`.
#[inline(never)]
pub(super) fn ranges<T: Real, const FEET: usize, const NQ: usize, const NV: usize>(
    robot: &WholeBody<T, FEET, NV>,
    settings: &WholeBodySettings<T, NV>,
    state: &WholeBodyState<T, NQ, NV>,
    accelerations: &[T; NV],
) -> Option<Ranges<T, FEET>> {
    let all = settings.ranges.as_ref()?;
    let rate = settings.range_rate;
    let mut found =
        Ranges { bounds: [[[T::zero(); 2]; MOST_LEG_JOINTS]; FEET], inertia: [T::zero(); FEET] };
    let feet = robot.legs.iter().zip(found.bounds.iter_mut().zip(&mut found.inertia));
    for (leg, (bounds, inertia)) in feet {
        let Some(leg) = leg else { continue };
        *inertia = robot.mass * leg.reach * leg.reach * T::of(INERTIA);
        for (bound, joint) in bounds.iter_mut().zip(leg.joints).take(leg.count) {
            let coordinate = robot.joints.get(joint)?.as_ref()?.coordinate;
            let angle = *state.positions.get(coordinate)?;
            let damped = *state.velocities.get(joint)? * rate * T::of(2.0);
            let planned = *accelerations.get(joint)?;
            *bound = all.get(joint)?.map(|end| (end - angle) * rate * rate - damped - planned);
        }
    }
    Some(found)
}

/// What a joint that tracks a posture does at most.
#[inline(always)]
pub(in super::super) fn kept<T: Real>(
    [least, greatest]: [T; 2],
    rate: T,
    (angle, velocity): (T, T),
    acceleration: T,
) -> T {
    let bound = |end: T| (end - angle) * rate * rate - velocity * rate * T::of(2.0);
    acceleration.min(bound(greatest)).max(bound(least))
}

impl<T: Real, const FEET: usize> Ranges<T, FEET> {
    /// A row as the solver takes it: its gradient, and its bound.
    pub fn row<const NV: usize>(
        &self,
        dynamics: &MotionDynamics<'_, T, FEET, NV>,
        (foot, joint): (usize, usize),
        sign: T,
        free: &[[T; MOST_LEG_JOINTS]; FEET],
    ) -> Option<([Unknowns<T>; FEET], T)> {
        let of_foot = dynamics.feet.get(foot)?.as_ref()?;
        if joint >= of_foot.contact.count {
            return None;
        }
        let inertia = *self.inertia.get(foot)? * sign;
        let per_base = of_foot.contact.per_base.get(joint)?;
        let mut gradient = dynamics.per_unknown(&dynamics.for_base(&per_base.to_array()));
        if of_foot.limits.is_none() {
            let own = of_foot.contact.per_foot(joint);
            for (to, x) in gradient.get_mut(foot)?.iter_mut().zip(own) {
                *to += x;
            }
        }
        gradient.as_flattened_mut().iter_mut().for_each(|x| *x *= inertia);
        let [least, greatest] = *self.bounds.get(foot)?.get(joint)?;
        let bound = if sign > T::zero() { least } else { greatest };
        let free = *free.get(foot)?.get(joint)?;
        Some((gradient, (bound - free) * inertia))
    }

    /// Each row's number within its foot, with its slack, where the unknowns move the legs so.
    pub fn slacks<const NV: usize>(
        &self,
        dynamics: &MotionDynamics<'_, T, FEET, NV>,
        moved: &Moved<T, FEET>,
        mut offer: impl FnMut(usize, usize, [T; 2]),
    ) {
        let legs = dynamics.legs(moved);
        let all = dynamics.feet.iter().zip(&legs).zip(self.bounds.iter().zip(&self.inertia));
        for (number, ((foot, leg), (bounds, inertia))) in all.enumerate() {
            let Some(foot) = foot else { continue };
            let joints = leg.iter().zip(bounds).take(foot.contact.count).enumerate();
            for (joint, (acceleration, [least, greatest])) in joints {
                let slack = [*greatest - *acceleration, *acceleration - *least];
                offer(number, joint, slack.map(|x| x * *inertia));
            }
        }
    }
}

//! The tick's program, as the solver takes it. Rows are numbered as those of
//! [`WholeBodyProgram`](super::super::program::WholeBodyProgram); a foot that swings has none of its own.

use super::super::WholeBodyLimit;
use super::super::leg_inverse::DIRECTIONS;
use super::super::program::{TORQUES, range_row, torque_row, worst};
use super::super::robot::WHOLE_BODY_FEET;
use super::dynamics::{MotionDynamics, Unknowns};
use super::objective::Objective;
use super::range::Ranges;
use crate::Real;
use crate::balance::contact_wrenches::{CONTACT_ROWS, first_row, greatest, reliefs, split_row};
use crate::qp::{ActiveRows, Program, ProgramCost, Search, Work};
use crate::spatial::{Twist, Wrench};

/// The program of one tick.
pub(super) struct MotionProgram<'a, T, const FEET: usize, const NV: usize> {
    pub dynamics: &'a MotionDynamics<'a, T, FEET, NV>,
    pub objective: &'a Objective<T, FEET>,
    /// Greatest torques.
    pub torques: &'a [T; NV],
    /// `X` where all unknowns are zero.
    pub free: Twist<T>,
    /// Of the legs' joints.
    pub ranges: Option<&'a Ranges<T, FEET>>,
}

/// A row's normal, in sole axes.
#[derive(Clone, Copy, Debug)]
pub(super) enum Normal<T, const FEET: usize> {
    /// On one foot.
    OnFoot(usize, Unknowns<T>),
    /// On all of them.
    OnAll([Unknowns<T>; FEET]),
}

#[inline(always)]
fn dot<T: Real>(a: &Unknowns<T>, b: &Unknowns<T>) -> T {
    a.iter().zip(b).fold(T::zero(), |sum, (a, b)| sum + *a * *b)
}

impl<T: Real, const FEET: usize, const NV: usize> MotionProgram<'_, T, FEET, NV> {
    /// The limit that costs most, with its relief.
    pub fn worst<const K: usize>(
        &self,
        x: &[Unknowns<T>; FEET],
        active: &ActiveRows<T, K>,
    ) -> Option<(WholeBodyLimit, T)> {
        let mut pressing = [None; FEET];
        for ((to, foot), [_, _, fz, ..]) in pressing.iter_mut().zip(self.dynamics.feet).zip(x) {
            *to = foot.as_ref().and_then(|foot| Some((foot.limits.as_ref()?, *fz)));
        }
        let most = worst(greatest(reliefs(&pressing, active)), self.torques, active);
        let Some(ranges) = self.ranges else { return most };
        active.iter().fold(most, |most, (row, multiplier)| {
            let (foot, own) = split_row(row);
            let Some((joint, sign)) = range_row(own).filter(|_| row < TORQUES) else { return most };
            let Some((_, bound)) = self.range(ranges, (foot, joint), sign) else { return most };
            let relief = multiplier * bound.abs();
            match most {
                Some((_, greatest)) if greatest > relief => most,
                _ => Some((WholeBodyLimit::Range { velocity: self.joint(foot, joint) }, relief)),
            }
        })
    }

    /// Velocity of a leg's joint, by number from the foot.
    pub fn joint(&self, foot: usize, number: usize) -> usize {
        let leg = self.dynamics.robot.legs.get(foot).and_then(Option::as_ref);
        leg.and_then(|leg| leg.joints.get(number)).copied().unwrap_or(0)
    }

    #[inline(never)]
    fn range(
        &self,
        ranges: &Ranges<T, FEET>,
        at: (usize, usize),
        sign: T,
    ) -> Option<([Unknowns<T>; FEET], T)> {
        let nothing = [[T::zero(); DIRECTIONS]; FEET];
        let free = self.dynamics.legs(&self.dynamics.moved(&nothing));
        ranges.row(self.dynamics, at, sign, &free)
    }
}

impl<T: Real, const FEET: usize, const NV: usize> Program<T> for MotionProgram<'_, T, FEET, NV> {
    type Point = [Unknowns<T>; FEET];
    type Normal = Normal<T, FEET>;
    type Factor = ();

    const COST: ProgramCost = {
        // As if all places had feet: a robot's work does not depend on how many it is given room for.
        let (feet, joints) = (WHOLE_BODY_FEET as Work, NV.saturating_sub(6) as Work);
        ProgramCost {
            factor: 0,
            response: 36 + 84 * feet,
            row: 36 + 80 * feet,
            product: 6 * feet,
            scan: 36 + 110 * feet + 12 * joints,
        }
    };

    #[inline(always)]
    fn minimum(&self) -> Self::Point {
        self.objective.minimum
    }

    #[inline(always)]
    fn zero(&self) -> Self::Point {
        [[T::zero(); DIRECTIONS]; FEET]
    }

    #[inline(always)]
    fn moved(&self, x: &Self::Point, by: &Self::Point) -> Self::Point {
        let mut sum = *x;
        for (x, by) in sum.as_flattened_mut().iter_mut().zip(by.as_flattened()) {
            *x += *by;
        }
        sum
    }

    #[inline(always)]
    fn is_finite(&self, x: &Self::Point) -> bool {
        x.as_flattened().iter().all(|x| x.is_finite())
    }

    #[inline(always)]
    fn factor(&self) -> Option<()> {
        Some(())
    }

    #[inline(always)]
    fn response(&self, (): &(), gradient: &Self::Point) -> Self::Point {
        self.objective.response(gradient)
    }

    #[inline(always)]
    fn row(&self, row: u8) -> Option<(Self::Normal, T)> {
        if let Some((velocity, sign)) = torque_row::<T>(row) {
            let limit = *self.torques.get(velocity)?;
            let mut normal = self.dynamics.torque_per_unknown(velocity)?;
            normal.as_flattened_mut().iter_mut().for_each(|x| *x *= sign);
            let free = self.dynamics.free_torque(velocity, self.free);
            return Some((Normal::OnAll(normal), -limit - free * sign));
        }
        let (foot, own) = split_row(row);
        if let Some((joint, sign)) = range_row(own) {
            let (normal, bound) = self.range(self.ranges?, (foot, joint), sign)?;
            return Some((Normal::OnAll(normal), bound));
        }
        let limits = self.dynamics.feet.get(foot)?.as_ref()?.limits.as_ref()?;
        let (normal, bound) = limits.contact_row(own)?;
        Some((Normal::OnFoot(foot, normal.to_array()), bound))
    }

    #[inline(always)]
    fn product(&self, normal: &Self::Normal, x: &Self::Point) -> T {
        match normal {
            Normal::OnFoot(foot, normal) => x.get(*foot).map_or(T::zero(), |x| dot(normal, x)),
            Normal::OnAll(all) => {
                all.iter().zip(x).fold(T::zero(), |sum, (normal, x)| sum + dot(normal, x))
            }
        }
    }

    #[inline(always)]
    fn accumulate(&self, gradient: &mut Self::Point, normal: &Self::Normal, multiplier: T) {
        let add = |to: &mut Unknowns<T>, normal: &Unknowns<T>| {
            for (to, x) in to.iter_mut().zip(normal) {
                *to += *x * multiplier;
            }
        };
        match normal {
            Normal::OnFoot(foot, normal) => {
                if let Some(to) = gradient.get_mut(*foot) {
                    add(to, normal);
                }
            }
            Normal::OnAll(all) => {
                for (to, normal) in gradient.iter_mut().zip(all) {
                    add(to, normal);
                }
            }
        }
    }

    #[inline(always)]
    fn scan(&self, x: &Self::Point, search: &mut Search<'_, T>) {
        for (number, (foot, x)) in self.dynamics.feet.iter().zip(x).enumerate() {
            if let Some(limits) = foot.as_ref().and_then(|foot| foot.limits.as_ref()) {
                limits.scan_contact(&Wrench::from_array(*x), first_row(number), search);
            }
        }
        let moved = self.dynamics.moved(x);
        let torques = self.dynamics.torques(&moved);
        let joints = self.dynamics.robot.joints.iter().zip(self.torques).zip(&torques);
        for (((joint, limit), torque), row) in joints.skip(6).zip((TORQUES..=u8::MAX).step_by(2)) {
            if joint.is_some() {
                search.offer_pair(*limit, *torque, [row, row.wrapping_add(1)]);
            }
        }
        if let Some(ranges) = self.ranges {
            ranges.slacks(self.dynamics, &moved, |foot, joint, slacks| {
                let own = CONTACT_ROWS.wrapping_add((joint as u8).wrapping_mul(2));
                let first = first_row(foot).wrapping_add(own);
                search.offer(first, slacks[0]);
                search.offer(first.wrapping_add(1), slacks[1]);
            });
        }
    }
}

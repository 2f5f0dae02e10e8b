//! Which limit an answer owes most to.

use super::rows::split_row;
use super::{ContactLimit, ContactLimits, ContactProgram};
use crate::Real;
use crate::qp::ActiveRows;
use crate::spatial::Wrench;

/// A limit of a foot, and what it costs.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Reason<T> {
    /// Index of the foot.
    pub foot: usize,
    /// The limit.
    pub limit: ContactLimit,
    /// By how much the objective falls per 100 % by which the limit is widened: the sum over its rows
    /// of multiplier times the limit's own term. One unit for all limits.
    pub relief: T,
}

impl<T: Real, const FEET: usize, const JOINTS: usize> ContactProgram<'_, T, FEET, JOINTS> {
    /// Every limit that has a row in force, with its relief, once each.
    #[inline(always)]
    pub fn reliefs<const K: usize>(
        &self,
        wrenches: &[Wrench<T>; FEET],
        active: &ActiveRows<T, K>,
    ) -> impl Iterator<Item = Reason<T>> + use<T, FEET, JOINTS, K> {
        let mut feet = [None; FEET];
        for ((to, foot), wrench) in feet.iter_mut().zip(0..).zip(wrenches) {
            *to = self.foot(foot).map(|at| {
                let force = at.rotation.column(2).dot(&wrench.force) + at.carried.force.z;
                (at.limits, force)
            });
        }
        reliefs(&feet, active)
    }

    /// The greatest of them; `None` where nothing binds.
    #[inline(always)]
    pub fn reason<const K: usize>(
        &self,
        wrenches: &[Wrench<T>; FEET],
        active: &ActiveRows<T, K>,
    ) -> Option<Reason<T>> {
        greatest(self.reliefs(wrenches, active))
    }
}

/// Every limit of feet that has a row in force, with its relief, once each: from the limits of those that
/// press, with the ground's force normal to their soles.
#[inline(always)]
pub(in crate::balance) fn reliefs<
    T: Real,
    const FEET: usize,
    const JOINTS: usize,
    const K: usize,
>(
    feet: &[Option<(&ContactLimits<T, JOINTS>, T)>; FEET],
    active: &ActiveRows<T, K>,
) -> impl Iterator<Item = Reason<T>> + use<T, FEET, JOINTS, K> {
    // Sums over each limit's rows, in one pass over all rows.
    let mut reliefs = [[None; LIMITS]; FEET];
    for (row, multiplier) in active.iter() {
        let (foot, own) = split_row(row);
        let limit = ContactLimit::of_row(own, JOINTS as u8);
        let Some(Some((limits, fz))) = feet.get(foot) else { continue };
        if let Some(relief) = reliefs.get_mut(foot).and_then(|all| all.get_mut(place(limit))) {
            let before = relief.unwrap_or_else(T::zero);
            *relief = Some(before + multiplier * limits.limit_term(limit, row, *fz));
        }
    }
    reliefs.into_iter().enumerate().flat_map(|(foot, reliefs)| {
        reliefs.into_iter().enumerate().filter_map(move |(place, relief)| {
            relief.map(|relief| Reason { foot, limit: limit(place), relief })
        })
    })
}

/// The one with the greatest relief.
#[inline(always)]
pub(in crate::balance) fn greatest<T: Real>(
    reasons: impl Iterator<Item = Reason<T>>,
) -> Option<Reason<T>> {
    reasons.fold(None, |most: Option<Reason<T>>, one| match most {
        Some(most) if most.relief >= one.relief => Some(most),
        _ => Some(one),
    })
}

/// Limits of a foot whose leg has at most seven joints.
const LIMITS: usize = 12;

/// Where a limit stands among those of its foot.
#[inline(always)]
fn place(limit: ContactLimit) -> usize {
    match limit {
        ContactLimit::Lift => 0,
        ContactLimit::Press => 1,
        ContactLimit::Slip => 2,
        ContactLimit::Tip => 3,
        ContactLimit::Twist => 4,
        ContactLimit::Torque(joint) | ContactLimit::Range(joint) => 5 + usize::from(joint),
    }
}

/// Which limit stands there.
#[inline(always)]
fn limit(place: usize) -> ContactLimit {
    match place {
        0 => ContactLimit::Lift,
        1 => ContactLimit::Press,
        2 => ContactLimit::Slip,
        3 => ContactLimit::Tip,
        4 => ContactLimit::Twist,
        joint => ContactLimit::Torque(joint.saturating_sub(5) as u8),
    }
}

//! Which limit an answer owes most to.

use super::{ContactLimit, ContactProgram};
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
        let mut normal_forces = [T::zero(); FEET];
        for ((force, foot), wrench) in normal_forces.iter_mut().zip(0..).zip(wrenches) {
            if let Some(at) = self.foot(foot) {
                *force = at.rotation.column(2).dot(&wrench.force) + at.carried.force.z;
            }
        }
        // Sums over each limit's rows, in one pass over all rows.
        let mut reliefs = [[None; LIMITS]; FEET];
        for (row, multiplier) in active.iter() {
            let (foot, limit) = self.limit_of(row);
            let (Some(at), Some(fz)) = (self.foot(foot), normal_forces.get(foot)) else { continue };
            if let Some(relief) = reliefs.get_mut(foot).and_then(|all| all.get_mut(place(limit))) {
                let before = relief.unwrap_or_else(T::zero);
                *relief = Some(before + multiplier * at.limit_term(limit, row, *fz));
            }
        }
        reliefs.into_iter().enumerate().flat_map(|(foot, reliefs)| {
            reliefs.into_iter().enumerate().filter_map(move |(place, relief)| {
                relief.map(|relief| Reason { foot, limit: limit(place), relief })
            })
        })
    }

    /// The greatest of them; `None` where nothing binds.
    #[inline(always)]
    pub fn reason<const K: usize>(
        &self,
        wrenches: &[Wrench<T>; FEET],
        active: &ActiveRows<T, K>,
    ) -> Option<Reason<T>> {
        self.reliefs(wrenches, active).fold(None, |most: Option<Reason<T>>, one| match most {
            Some(most) if most.relief >= one.relief => Some(most),
            _ => Some(one),
        })
    }
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
        ContactLimit::Torque(joint) => 5 + usize::from(joint),
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

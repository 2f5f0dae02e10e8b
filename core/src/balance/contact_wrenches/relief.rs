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
    pub fn reliefs<'s, const K: usize>(
        &'s self,
        wrenches: &'s [Wrench<T>; FEET],
        active: &'s ActiveRows<T, K>,
    ) -> impl Iterator<Item = Reason<T>> + 's {
        let key = |row| self.limit_of(row);
        active.iter().enumerate().filter_map(move |(place, (row, _))| {
            let (foot, limit) = key(row);
            // Counted at its first row.
            if active.iter().take(place).any(|(earlier, _)| key(earlier) == (foot, limit)) {
                return None;
            }
            let (at, wrench) = (self.foot(foot)?, wrenches.get(foot)?);
            let normal_force = (at.in_sole_axes(wrench) + at.carried).force.z;
            let of_limit = active.iter().filter(|(row, _)| key(*row) == (foot, limit));
            let relief = of_limit.fold(T::zero(), |sum, (row, multiplier)| {
                sum + multiplier * at.limit_term(limit, row, normal_force)
            });
            Some(Reason { foot, limit, relief })
        })
    }

    /// The greatest of them; `None` where nothing binds.
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

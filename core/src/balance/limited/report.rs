//! What limits made of a tick's wish.

use crate::Real;
use crate::balance::robot::LEG;
use crate::balance::{Command, ContactLimit, Reason};
use crate::qp::{Status, Work};
use crate::spatial::Wrench;

/// A command within limits, and what they did to it.
#[derive(Clone, Copy, Debug)]
pub struct LimitedCommand<T, const LEGS: usize> {
    /// As of [`tick`](crate::balance::tick). Its foot wrenches are those within the limits,
    /// its desired wrench is the one before them.
    pub command: Command<T, LEGS>,
    /// What binds, and what is given up.
    pub limits: LimitReport<T, LEGS>,
}

/// What binds in a tick, by how much, and what is given up for it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LimitReport<T, const LEGS: usize> {
    /// How the distribution ended; solved where nothing binds.
    pub status: Status,
    /// The limits of each leg that bind.
    pub binding: [LimitSet; LEGS],
    /// The one that costs most, with its relief; `None` where nothing binds.
    pub worst: Option<Reason<T>>,
    /// The limit that the wrenches break most, in what is solved by giving way, and otherwise because
    /// the work was spent; `None` where none is by more than the tolerance. Torques are cut in any case.
    pub broken: Option<BrokenLimit<T>>,
    /// Desired wrench less the one that is made, on the central body, in its frame (N, N·m).
    pub given_up: Wrench<T>,
    /// Limits taken in and let go.
    pub changes: u32,
    /// Multiplications spent on the distribution.
    pub work: Work,
}

/// A limit that is broken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BrokenLimit<T> {
    /// Number of the leg.
    pub leg: usize,
    /// Its limit.
    pub limit: ContactLimit,
    /// By how much: N for lift, press and slip, N·m for the others.
    pub amount: T,
}

impl<T: Real, const LEGS: usize> LimitReport<T, LEGS> {
    /// Of a tick in which nothing binds.
    #[inline(always)]
    pub(super) fn free() -> Self {
        Self {
            status: Status::Solved,
            binding: [LimitSet::default(); LEGS],
            worst: None,
            broken: None,
            given_up: Wrench::zero(),
            changes: 0,
            work: 0,
        }
    }

    /// Whether some limit binds.
    pub fn is_limited(&self) -> bool {
        self.worst.is_some() || self.status != Status::Solved
    }
}

/// A set of limits of one leg.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LimitSet(u16);

/// Limits of the contact, before those of torques.
const CONTACT: [ContactLimit; 5] = [
    ContactLimit::Lift,
    ContactLimit::Press,
    ContactLimit::Slip,
    ContactLimit::Tip,
    ContactLimit::Twist,
];

impl LimitSet {
    fn bit(limit: ContactLimit) -> u16 {
        match limit {
            ContactLimit::Lift => 1,
            ContactLimit::Press => 1 << 1,
            ContactLimit::Slip => 1 << 2,
            ContactLimit::Tip => 1 << 3,
            ContactLimit::Twist => 1 << 4,
            ContactLimit::Torque(joint) => 1_u16.checked_shl(5 + u32::from(joint)).unwrap_or(0),
            // Reported by joint.
            ContactLimit::Range(_) => 0,
        }
    }

    pub(in crate::balance) fn insert(&mut self, limit: ContactLimit) {
        self.0 |= Self::bit(limit);
    }

    /// Whether a limit is in it.
    pub fn contains(self, limit: ContactLimit) -> bool {
        self.0 & Self::bit(limit) != 0
    }

    /// Whether none is.
    pub fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// Those in it.
    pub fn iter(self) -> impl Iterator<Item = ContactLimit> {
        let torques = (0..LEG as u8).map(ContactLimit::Torque);
        CONTACT.into_iter().chain(torques).filter(move |limit| self.contains(*limit))
    }
}

//! What is required of an answer, and what an answer tells.

use super::{Violation, Work};
use crate::Real;

/// What is required of an answer, and what it may take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings<T> {
    /// δ > 0: how far a row gives way per unit of its multiplier.
    pub softness: T,
    /// By how much a row may be broken, beyond what it gives way, before it is taken in.
    pub tolerance: T,
    /// Rows contradict each other where one gives way by more than this.
    pub margin: T,
    /// Multiplications that may be spent; [`solve`](super::solve) says which are counted.
    pub work: Work,
}

impl<T: Real> Settings<T> {
    /// No limit of work, no margin, and a tolerance for rows whose terms are of the order of 1000:
    /// 0.02 in f32, which is 300 roundings of such a term, and 1e-9 in f64.
    pub fn new(softness: T) -> Self {
        let single = T::default_epsilon() > T::of(1e-10);
        Self {
            softness,
            tolerance: T::of(if single { 0.02 } else { 1e-9 }),
            margin: T::of(f64::from(f32::MAX)),
            work: Work::MAX,
        }
    }
}

/// How a solution ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// The answer is the program's.
    Solved,
    /// It is the program's, and a row gives way by more than the margin: rows contradict each other.
    Contradiction,
    /// The work is spent before the answer was reached. The rows held so far are kept for the next
    /// call; x is that of their multipliers.
    BudgetSpent,
    /// More rows bind than there is room for; as before.
    TooManyRows,
}

/// Why there is no answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// A number of the program, or one that it leads to, is not finite.
    NotFinite,
    /// The Hessian has a pivot that is not positive.
    NotPositiveDefinite,
    /// The program offered a row that it does not have.
    NoSuchRow {
        /// Its number.
        row: u8,
    },
}

/// An answer. Multipliers are in the [`ActiveRows`](super::ActiveRows).
#[derive(Clone, Copy, Debug)]
pub struct Solution<T, X> {
    /// `x`
    pub x: X,
    /// How it ended.
    pub status: Status,
    /// The row that is broken most: for a solved program, the one that gives way most. `None` where
    /// none is broken by more than the tolerance.
    pub violation: Option<Violation<T>>,
    /// Rows that are not held are broken by no more than this in a solved program: the tolerance, or
    /// more of it where round-off let the same rows come and go.
    pub tolerance: T,
    /// Rows taken in and let go, those of a warm start aside.
    pub changes: u32,
    /// Multiplications spent.
    pub work: Work,
}

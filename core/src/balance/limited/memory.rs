//! What one tick within limits leaves for the next.

use crate::Real;
use crate::qp::ActiveRows;

/// Limits that may bind at once: two feet have twelve unknowns, and rows of which some depend on each
/// other give way together.
pub(super) const ROWS: usize = 16;

/// What one tick within limits leaves for the next, of legs of six joints.
pub type LimitMemory<T> = BindingRows<T, ROWS>;

/// The limits that bound at the last tick, from which the next one begins. It belongs to the caller,
/// one for each robot; a new one is a cold start, dearer and to the same answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BindingRows<T, const ROWS: usize> {
    pub(in crate::balance) active: ActiveRows<T, ROWS>,
}

impl<T: Real, const ROWS: usize> BindingRows<T, ROWS> {
    /// Before the first tick.
    pub fn new() -> Self {
        Self { active: ActiveRows::new() }
    }

    /// Rows of the program and their multipliers, to be kept.
    pub fn rows(&self) -> impl Iterator<Item = (u8, T)> + '_ {
        self.active.iter()
    }

    /// As [`rows`](Self::rows) gave it.
    pub fn of(rows: impl IntoIterator<Item = (u8, T)>) -> Self {
        Self { active: ActiveRows::of(rows) }
    }
}

impl<T: Real, const ROWS: usize> Default for BindingRows<T, ROWS> {
    fn default() -> Self {
        Self::new()
    }
}

//! The rows that hold a solution where it is, carried from call to call.

use crate::Real;

/// At most `K` rows in force, with their multipliers. The solver begins with those that it is given
/// and leaves those of its answer; empty for a cold start.
///
/// ```text
/// gradient of the objective at the answer = Σ λ_j a_j,    λ_j > 0,    s_j = δ λ_j
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ActiveRows<T, const K: usize> {
    pub(super) rows: [u8; K],
    pub(super) multipliers: [T; K],
    pub(super) count: usize,
}

impl<T: Real, const K: usize> ActiveRows<T, K> {
    /// No rows: a cold start.
    #[inline(always)]
    pub fn new() -> Self {
        Self { rows: [0; K], multipliers: [T::zero(); K], count: 0 }
    }

    /// These rows with their multipliers, as [`iter`](Self::iter) gives them: what another one left.
    /// More than `K` are left out.
    pub fn of(rows: impl IntoIterator<Item = (u8, T)>) -> Self {
        let mut active = Self::new();
        let places = active.rows.iter_mut().zip(&mut active.multipliers);
        for ((place, multiplier), (row, value)) in places.zip(rows) {
            (*place, *multiplier) = (row, value);
            active.count += 1;
        }
        active
    }

    /// How many rows are in force.
    #[inline(always)]
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether no row is in force.
    #[inline(always)]
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Each row's number with its multiplier `λ ≥ 0`, in the order in which they came.
    #[inline(always)]
    pub fn iter(&self) -> impl Iterator<Item = (u8, T)> + '_ {
        self.rows.iter().copied().zip(self.multipliers.iter().copied()).take(self.count)
    }
}

impl<T: Real, const K: usize> Default for ActiveRows<T, K> {
    fn default() -> Self {
        Self::new()
    }
}

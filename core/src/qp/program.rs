//! What the solver has to know of a program.

use super::Work;
use crate::Real;

/// A strictly convex program with soft rows, known to the solver by what it can do:
///
/// ```text
/// minimise  ½ (x − x₀)ᵀ H (x − x₀) + (1/2δ) ‖s‖²,    a_j · x ≥ b_j − s_j    (j < 256)
/// ```
/// The Hessian is never asked for, only `H⁻¹ g`, so that a program with a structure can use it. Rows
/// are made one by one, when they take part, and tested all at once.
///
/// [`DenseProgram`](super::DenseProgram) is the implementation for a Hessian and rows that are just
/// numbers.
pub trait Program<T: Real> {
    /// A vector of as many numbers as there are unknowns: `x`, or a gradient `Aᵀ λ`.
    type Point: Copy;
    /// A row's normal `a`, in any form.
    type Normal: Copy;
    /// Whatever `H⁻¹ g` needs that is not needed while no row is broken.
    type Factor;

    /// What each of the functions costs, in multiplications.
    const COST: ProgramCost;

    /// `x₀`.
    fn minimum(&self) -> Self::Point;

    /// All zero.
    fn zero(&self) -> Self::Point;

    /// `x + d`.
    fn moved(&self, x: &Self::Point, by: &Self::Point) -> Self::Point;

    /// Whether every number of a point is finite.
    fn is_finite(&self, x: &Self::Point) -> bool;

    /// Factors the Hessian; `None` where it is not positive definite (or not finite).
    fn factor(&self) -> Option<Self::Factor>;

    /// `H⁻¹ g`.
    fn response(&self, factor: &Self::Factor, gradient: &Self::Point) -> Self::Point;

    /// The same of one row's normal. At most as many multiplications.
    #[inline(always)]
    fn row_response(&self, factor: &Self::Factor, normal: &Self::Normal) -> Self::Point {
        let mut gradient = self.zero();
        self.accumulate(&mut gradient, normal, T::one());
        self.response(factor, &gradient)
    }

    /// Normal and bound of a row; `None` where there is no such row. What exists may change from
    /// call to call.
    fn row(&self, row: u8) -> Option<(Self::Normal, T)>;

    /// `a · x`.
    fn product(&self, normal: &Self::Normal, x: &Self::Point) -> T;

    /// `g + a λ`.
    fn accumulate(&self, gradient: &mut Self::Point, normal: &Self::Normal, multiplier: T);

    /// Tests every row at `x` and offers each to `search`, whose fields tell which may be passed
    /// over.
    fn scan(&self, x: &Self::Point, search: &mut Search<'_, T>);
}

/// Multiplications in the functions of a [`Program`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ProgramCost {
    /// [`Program::factor`]
    pub factor: Work,
    /// [`Program::response`]
    pub response: Work,
    /// [`Program::row`]
    pub row: Work,
    /// [`Program::product`] and [`Program::accumulate`]
    pub product: Work,
    /// [`Program::scan`]
    pub scan: Work,
}

/// A row that is broken, and by how much.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Violation<T> {
    /// The row's number.
    pub row: u8,
    /// `b − a · x`, in the row's unit, positive.
    pub amount: T,
}

/// The search for the row that is broken most, those aside which are held.
#[derive(Debug)]
pub struct Search<'a, T> {
    held: &'a RowSet,
    /// `a · x − b` of the worst row yet; at the beginning, less the tolerance.
    least: T,
    row: Option<u8>,
}

impl<'a, T: Real> Search<'a, T> {
    /// For rows broken by more than `tolerance`.
    #[inline(always)]
    pub(crate) fn new(held: &'a RowSet, tolerance: T) -> Self {
        Self { held, least: -tolerance, row: None }
    }

    /// Whether a row with this `a · x − b` would be the worst yet. True for what is not a number, so
    /// that it comes to light.
    #[inline(always)]
    pub fn wants(&self, slack: T) -> bool {
        !(slack >= self.least)
    }

    /// Offers a row with its `a · x − b`.
    #[inline(always)]
    pub fn offer(&mut self, row: u8, slack: T) {
        if self.wants(slack) && self.least.is_finite() && !self.held.contains(row) {
            self.least = slack;
            self.row = Some(row);
        }
    }

    /// Offers the pair of rows `limit − x ≥ 0` and `limit + x ≥ 0`. One comparison where neither is
    /// broken.
    #[inline(always)]
    pub fn offer_pair(&mut self, limit: T, x: T, rows: [u8; 2]) {
        if self.wants(limit - x.abs()) {
            self.offer(rows[0], limit - x);
            self.offer(rows[1], limit + x);
        }
    }

    #[inline(always)]
    pub(crate) fn worst(self) -> Option<Violation<T>> {
        self.row.map(|row| Violation { row, amount: -self.least })
    }
}

/// A set of row numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RowSet([u32; 8]);

impl RowSet {
    /// Whether a row is in it.
    #[inline(always)]
    pub fn contains(&self, row: u8) -> bool {
        self.0[usize::from(row >> 5)] & (1 << (row & 31)) != 0
    }

    #[inline(always)]
    pub(super) fn insert(&mut self, row: u8) {
        self.0[usize::from(row >> 5)] |= 1 << (row & 31);
    }

    #[inline(always)]
    pub(super) fn remove(&mut self, row: u8) {
        self.0[usize::from(row >> 5)] &= !(1 << (row & 31));
    }
}

//! Factors of the active rows' Schur complement, which grow and shrink by a row.
//!
//! # Notation
//! k rows are active; `A` has their normals as rows.
//! ```text
//! S = A H⁻¹ Aᵀ + δ 1 = L D Lᵀ                                                (1)
//! L D y = r,  r_j = b_j − a_j · x₀;     Lᵀ λ* = y                            (2)
//! ```
//! `L` and `y` are as if `r` were one more row of the matrix, which is why both are updated alike.

use super::{ActiveRows, Work};
use crate::Real;

/// `L`, `D` and `y` of at most `K` rows, and what is known of each row.
pub(super) struct Factors<T, N, const K: usize> {
    rows: [u8; K],
    normals: [N; K],
    multipliers: [T; K],
    lower: [[T; K]; K],
    pivots: [T; K],
    inverse_pivots: [T; K],
    y: [T; K],
    /// Row of `L D` of the row that is being taken in: here, so that nothing is cleared for it.
    scaled: [T; K],
    count: usize,
}

/// Multiplications of [`Factors::append`] to k rows.
pub(super) const fn append_cost(k: usize) -> Work {
    (k * (k + 5) / 2 + 4) as Work
}

/// Multiplications of [`Factors::remove`] of the row `at` of k.
pub(super) const fn remove_cost(k: usize, at: usize) -> Work {
    let m = k.saturating_sub(at + 1);
    (m * (m + 6) + k) as Work
}

/// Multiplications of [`Factors::optimum`] with k rows and the steps that follow it.
pub(super) const fn optimum_cost(k: usize) -> Work {
    (k * (k + 3) / 2) as Work
}

impl<T: Real, N: Copy, const K: usize> Factors<T, N, K> {
    /// No rows. The normal is what the places for rows are filled with.
    #[inline(always)]
    pub fn new(filling: N) -> Self {
        Self {
            rows: [0; K],
            normals: [filling; K],
            multipliers: [T::zero(); K],
            lower: [[T::zero(); K]; K],
            pivots: [T::zero(); K],
            inverse_pivots: [T::zero(); K],
            y: [T::zero(); K],
            scaled: [T::zero(); K],
            count: 0,
        }
    }

    /// Rows that are active.
    #[inline(always)]
    pub fn len(&self) -> usize {
        // So that the compiler sees that no index below is out of bounds.
        self.count.min(K)
    }

    /// Takes a row in: `product` gives its `a · H⁻¹ a_j` with the normal of a row before it, `own` is
    /// that with itself plus δ, `residual` its `r`. Does nothing where there is no room.
    #[inline(always)]
    pub fn append(
        &mut self,
        (row, normal, multiplier): (u8, N, T),
        product: impl Fn(&N) -> T,
        own: T,
        residual: T,
        softness: T,
    ) {
        let k = self.len();
        if k >= K {
            return;
        }
        let mut pivot = own;
        let mut z = residual;
        for j in 0..k {
            let mut x = product(&self.normals[j]);
            for m in 0..j {
                x -= self.lower[j][m] * self.scaled[m];
            }
            self.scaled[j] = x;
            let l = x * self.inverse_pivots[j];
            self.lower[k][j] = l;
            pivot -= x * l;
            z -= x * self.y[j];
        }
        // By (1) no pivot is below δ; round-off would have it otherwise where rows depend.
        if pivot < softness {
            pivot = softness;
        }
        self.rows[k] = row;
        self.normals[k] = normal;
        self.multipliers[k] = multiplier;
        self.pivots[k] = pivot;
        self.inverse_pivots[k] = T::one() / pivot;
        self.y[k] = z * self.inverse_pivots[k];
        self.count = k + 1;
    }

    /// `λ*` of (2): the multipliers that hold exactly these rows, of either sign.
    #[inline(always)]
    pub fn optimum(&self) -> [T; K] {
        let mut star = self.y;
        for (i, row) in self.lower.iter().enumerate().take(self.len()).rev() {
            let held = star.get_mut(..=i).and_then(|held| held.split_last_mut());
            if let Some((last, before)) = held {
                for (x, l) in before.iter_mut().zip(row) {
                    *x -= *l * *last;
                }
            }
        }
        star
    }

    /// Takes the row at `at` out. What its column leaves to those behind it is a symmetric update of
    /// rank one, `L₃ D₃ L₃ᵀ + d l lᵀ`, positive and so stable (Gill, Golub, Murray, Saunders, *Math.
    /// Comp.* 28, 1974, method C1).
    #[inline(always)]
    pub fn remove(&mut self, at: usize) {
        let k = self.len();
        if at >= k {
            return;
        }
        // The column's part below the diagonal, where the rows will be that it belongs to.
        let mut column = [T::zero(); K];
        for (l, row) in column.iter_mut().zip(self.lower.iter().skip(1)).take(k - 1).skip(at) {
            *l = row.get(at).copied().unwrap_or_else(T::zero);
        }
        let mut y_left = self.y[at];
        let mut alpha = self.pivots[at];
        close_gap(&mut self.rows, at, k);
        close_gap(&mut self.normals, at, k);
        close_gap(&mut self.multipliers, at, k);
        close_gap(&mut self.pivots, at, k);
        close_gap(&mut self.inverse_pivots, at, k);
        close_gap(&mut self.y, at, k);
        close_gap(&mut self.lower, at, k);
        self.count = k - 1;
        for (m, row) in self.lower.iter_mut().enumerate().take(k - 1).skip(at) {
            close_gap(row, at, m + 1);
        }
        let pivots = self.pivots.iter_mut().zip(&mut self.inverse_pivots).zip(&mut self.y);
        for (j, ((pivot, inverse), y)) in pivots.enumerate().take(k - 1).skip(at) {
            let p = column.get(j).copied().unwrap_or_else(T::zero);
            let before = *pivot;
            *pivot += alpha * p * p;
            *inverse = T::one() / *pivot;
            let beta = alpha * p * *inverse;
            alpha *= before * *inverse;
            let behind = self.lower.iter_mut().zip(&mut column).take(k - 1).skip(j + 1);
            for (row, l) in behind {
                if let Some(x) = row.get_mut(j) {
                    *l -= p * *x;
                    *x += beta * *l;
                }
            }
            y_left -= p * *y;
            *y += beta * y_left;
        }
    }

    /// Whether no row is active.
    #[inline(always)]
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Each row's normal and multiplier.
    #[inline(always)]
    pub fn iter(&self) -> impl Iterator<Item = (&N, T)> {
        self.normals.iter().zip(self.multipliers.iter().copied()).take(self.count)
    }

    /// The row whose multiplier is the first to be zero on the straight line to `optimum`: its place,
    /// its number, and the share of that line; `None` where none turns negative.
    #[inline(always)]
    pub fn first_to_leave(&self, optimum: &[T; K]) -> Option<(usize, u8, T)> {
        let mut first: Option<(usize, u8, T)> = None;
        let lines = self.rows.iter().zip(self.multipliers.iter().zip(optimum));
        for (at, (row, (from, to))) in lines.enumerate().take(self.count) {
            if *to < T::zero() {
                let share = *from / (*from - *to);
                if first.is_none_or(|(_, _, least)| share < least) {
                    first = Some((at, *row, share));
                }
            }
        }
        first
    }

    /// Goes a share of that line.
    #[inline(always)]
    pub fn go_towards(&mut self, optimum: &[T; K], share: T) {
        for (multiplier, to) in self.multipliers.iter_mut().zip(optimum).take(self.count) {
            let next = *multiplier + (*to - *multiplier) * share;
            // Round-off must not make a multiplier negative; what is not a number stays and shows.
            *multiplier = if next < T::zero() { T::zero() } else { next };
        }
    }

    /// Hands rows and multipliers over.
    #[inline(always)]
    pub fn leave_in(&self, active: &mut ActiveRows<T, K>) {
        *active = ActiveRows { rows: self.rows, multipliers: self.multipliers, count: self.len() };
    }
}

/// Moves the places behind `at`, up to `end`, forward by one.
#[inline(always)]
fn close_gap<X: Copy>(places: &mut [X], at: usize, end: usize) {
    let mut places = places.iter_mut().take(end).skip(at);
    if let Some(mut to) = places.next() {
        for from in places {
            *to = *from;
            to = from;
        }
    }
}

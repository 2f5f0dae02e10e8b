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
        let zero = [T::zero(); K];
        Self {
            rows: [0; K],
            normals: [filling; K],
            multipliers: zero,
            lower: [zero; K],
            pivots: zero,
            inverse_pivots: zero,
            y: zero,
            count: 0,
        }
    }

    /// Rows that are active.
    #[inline(always)]
    pub fn len(&self) -> usize {
        // So that the compiler sees that no index below is out of bounds.
        self.count.min(K)
    }

    /// Takes a row in: `products` are its `a · H⁻¹ a_j` with the rows before it, `own` that with
    /// itself plus δ, `residual` its `r`. Does nothing where there is no room.
    #[inline(always)]
    pub fn append(
        &mut self,
        (row, normal, multiplier): (u8, N, T),
        mut products: [T; K],
        own: T,
        residual: T,
        softness: T,
    ) {
        let k = self.len();
        if k >= K {
            return;
        }
        // `products` becomes the row of L D.
        let mut pivot = own;
        let mut z = residual;
        for j in 0..k {
            let mut x = products[j];
            for m in 0..j {
                x -= self.lower[j][m] * products[m];
            }
            products[j] = x;
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
        let k = self.len();
        let mut star = self.y;
        for i in (1..k).rev() {
            let s = star[i];
            for j in 0..i {
                star[j] -= self.lower[i][j] * s;
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
        let mut column = [T::zero(); K];
        for m in at + 1..k {
            column[m - 1] = self.lower[m][at];
        }
        let mut y_left = self.y[at];
        let mut alpha = self.pivots[at];
        for m in at + 1..k {
            let (before, row) = (m - 1, self.lower[m]);
            for j in 0..at {
                self.lower[before][j] = row[j];
            }
            for j in at + 1..m {
                self.lower[before][j - 1] = row[j];
            }
            self.rows[before] = self.rows[m];
            self.normals[before] = self.normals[m];
            self.multipliers[before] = self.multipliers[m];
            self.pivots[before] = self.pivots[m];
            self.inverse_pivots[before] = self.inverse_pivots[m];
            self.y[before] = self.y[m];
        }
        self.count = k - 1;
        for j in at..k - 1 {
            let p = column[j];
            let pivot = self.pivots[j] + alpha * p * p;
            let inverse = T::one() / pivot;
            let beta = alpha * p * inverse;
            alpha *= self.pivots[j] * inverse;
            self.pivots[j] = pivot;
            self.inverse_pivots[j] = inverse;
            for m in j + 1..k - 1 {
                column[m] -= p * self.lower[m][j];
                self.lower[m][j] += beta * column[m];
            }
            y_left -= p * self.y[j];
            self.y[j] += beta * y_left;
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

//! Factors of six equations with six unknowns.
//!
//! `P A = L U` with row exchanges (Golub and Van Loan, *Matrix Computations*, alg. 3.4.1).

use crate::Real;

/// Unknowns.
const N: usize = 6;

/// `A`, factored.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Square<T> {
    /// Unit lower triangle `L` below the diagonal, `U` on and above it, by rows.
    factors: [[T; N]; N],
    /// Row of `A` that became row i.
    order: [usize; N],
    inverse_pivots: [T; N],
}

impl<T: Real> Square<T> {
    /// Factors a matrix, given by rows; `None` where a pivot is not greater than `least` (or is NaN).
    #[inline(always)]
    pub fn new(rows: [[T; N]; N], least: T) -> Option<Self> {
        let mut lu =
            Self { factors: rows, order: [0, 1, 2, 3, 4, 5], inverse_pivots: [T::zero(); N] };
        // One by one, so that all bounds of the loops inside are constants.
        lu.eliminate::<0>(least)?;
        lu.eliminate::<1>(least)?;
        lu.eliminate::<2>(least)?;
        lu.eliminate::<3>(least)?;
        lu.eliminate::<4>(least)?;
        lu.eliminate::<5>(least)?;
        Some(lu)
    }

    /// Brings the largest of column `K` to the diagonal, and eliminates what is below it.
    #[inline(always)]
    fn eliminate<const K: usize>(&mut self, least: T) -> Option<()> {
        let rows = &mut self.factors;
        let mut best = K;
        let mut size = rows[K][K].abs();
        for i in K + 1..N {
            let candidate = rows[i][K].abs();
            if candidate > size {
                best = i;
                size = candidate;
            }
        }
        // NaN compares as false.
        if !(size > least) {
            return None;
        }
        if let Ok([a, b]) = rows.get_disjoint_mut([K, best]) {
            core::mem::swap(a, b);
            if let Ok([a, b]) = self.order.get_disjoint_mut([K, best]) {
                core::mem::swap(a, b);
            }
        }
        let pivot_row = rows[K];
        let inverse = T::one() / pivot_row[K];
        self.inverse_pivots[K] = inverse;
        for i in K + 1..N {
            let factor = rows[i][K] * inverse;
            rows[i][K] = factor;
            for j in K + 1..N {
                rows[i][j] -= factor * pivot_row[j];
            }
        }
        Some(())
    }

    /// `x` with `A x = b`.
    #[inline(always)]
    pub fn solve(&self, b: &[T; N]) -> [T; N] {
        let mut x = [T::zero(); N];
        for i in 0..N {
            let mut sum = b.get(self.order[i]).copied().unwrap_or(T::zero());
            for j in 0..i {
                sum -= self.factors[i][j] * x[j];
            }
            x[i] = sum;
        }
        for i in (0..N).rev() {
            let mut sum = x[i];
            for j in i + 1..N {
                sum -= self.factors[i][j] * x[j];
            }
            x[i] = sum * self.inverse_pivots[i];
        }
        x
    }

    /// `x` with `Aᵀ x = b`.
    #[inline(always)]
    pub fn solve_transposed(&self, b: &[T; N]) -> [T; N] {
        let mut y = *b;
        for i in 0..N {
            let mut sum = y[i];
            for j in 0..i {
                sum -= self.factors[j][i] * y[j];
            }
            y[i] = sum * self.inverse_pivots[i];
        }
        for i in (0..N).rev() {
            let mut sum = y[i];
            for j in i + 1..N {
                sum -= self.factors[j][i] * y[j];
            }
            y[i] = sum;
        }
        let mut x = [T::zero(); N];
        for i in 0..N {
            if let Some(entry) = x.get_mut(self.order[i]) {
                *entry = y[i];
            }
        }
        x
    }
}

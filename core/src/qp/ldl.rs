//! `M = L D Lᵀ` of a dense symmetric matrix, L unit lower triangular (Golub and Van Loan, *Matrix
//! Computations*, 4th ed., alg. 4.1.2).

use super::Work;
use crate::Real;

/// The factors of a positive definite matrix of `N` rows.
#[derive(Clone, Copy, Debug)]
pub struct Ldl<T, const N: usize> {
    /// L below the diagonal; nothing is read elsewhere.
    lower: [[T; N]; N],
    inverse_pivots: [T; N],
}

/// Multiplications of a solution with `n` unknowns.
pub const fn solution_cost(n: usize) -> Work {
    (n * n) as Work
}

/// Multiplications of a factorisation.
pub const fn factor_cost(n: usize) -> Work {
    (n * (n + 1) * (n + 5) / 6) as Work
}

impl<T: Real, const N: usize> Ldl<T, N> {
    /// Factors a matrix, of which only the lower triangle is read; `None` where a pivot is not
    /// positive (also for NaN).
    #[inline(always)]
    pub fn new(matrix: &[[T; N]; N]) -> Option<Self> {
        let mut lower = *matrix;
        let mut inverse_pivots = [T::zero(); N];
        for i in 0..N {
            let mut pivot = lower[i][i];
            for j in 0..i {
                // L D, before it is divided.
                let mut x = lower[i][j];
                for m in 0..j {
                    x -= lower[i][m] * lower[j][m];
                }
                lower[i][j] = x;
            }
            for j in 0..i {
                let x = lower[i][j];
                lower[i][j] = x * inverse_pivots[j];
                pivot -= x * lower[i][j];
            }
            if !(pivot > T::zero() && pivot.is_finite()) {
                return None;
            }
            inverse_pivots[i] = T::one() / pivot;
        }
        Some(Self { lower, inverse_pivots })
    }

    /// `M⁻¹ b`.
    #[inline(always)]
    pub fn solve(&self, b: &[T; N]) -> [T; N] {
        let mut x = *b;
        for i in 1..N {
            for j in 0..i {
                x[i] -= self.lower[i][j] * x[j];
            }
        }
        for (x, pivot) in x.iter_mut().zip(&self.inverse_pivots) {
            *x *= *pivot;
        }
        for i in (1..N).rev() {
            for j in 0..i {
                x[j] -= self.lower[i][j] * x[i];
            }
        }
        x
    }
}

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
        let mut ldl = Self { lower: *matrix, inverse_pivots: [T::zero(); N] };
        for i in 0..N {
            let good = match i {
                0 => ldl.eliminate(0),
                1 => ldl.eliminate(1),
                2 => ldl.eliminate(2),
                3 => ldl.eliminate(3),
                4 => ldl.eliminate(4),
                5 => ldl.eliminate(5),
                _ => ldl.eliminate(i),
            };
            if !good {
                return None;
            }
        }
        Some(ldl)
    }

    /// Row `i`; whether its pivot is positive. Constant rows, in the arms above and below, have loops
    /// of constant length, which a compiler writes out: a third of the instructions.
    #[inline(always)]
    fn eliminate(&mut self, i: usize) -> bool {
        let mut row = self.lower[i];
        let mut pivot = row[i];
        for j in 0..i {
            // L D, before it is divided.
            let mut x = row[j];
            for m in 0..j {
                x -= row[m] * self.lower[j][m];
            }
            row[j] = x;
        }
        for j in 0..i {
            let x = row[j];
            row[j] = x * self.inverse_pivots[j];
            pivot -= x * row[j];
        }
        self.lower[i] = row;
        self.inverse_pivots[i] = T::one() / pivot;
        pivot > T::zero() && pivot.is_finite()
    }

    /// The least of D, which is not less than the least eigenvalue.
    #[inline(always)]
    pub fn least_pivot(&self) -> T {
        T::one() / self.inverse_pivots.iter().fold(T::zero(), |most, x| most.max(*x))
    }

    /// `M⁻¹ b`.
    #[inline(always)]
    pub fn solve(&self, b: &[T; N]) -> [T; N] {
        let mut x = *b;
        for i in 1..N {
            match i {
                1 => self.forward(1, &mut x),
                2 => self.forward(2, &mut x),
                3 => self.forward(3, &mut x),
                4 => self.forward(4, &mut x),
                5 => self.forward(5, &mut x),
                _ => self.forward(i, &mut x),
            }
        }
        for (x, pivot) in x.iter_mut().zip(&self.inverse_pivots) {
            *x *= *pivot;
        }
        for i in (1..N).rev() {
            match i {
                1 => self.backward(1, &mut x),
                2 => self.backward(2, &mut x),
                3 => self.backward(3, &mut x),
                4 => self.backward(4, &mut x),
                5 => self.backward(5, &mut x),
                _ => self.backward(i, &mut x),
            }
        }
        x
    }

    #[inline(always)]
    fn forward(&self, i: usize, x: &mut [T; N]) {
        for j in 0..i {
            x[i] -= self.lower[i][j] * x[j];
        }
    }

    #[inline(always)]
    fn backward(&self, i: usize, x: &mut [T; N]) {
        for j in 0..i {
            x[j] -= self.lower[i][j] * x[i];
        }
    }
}

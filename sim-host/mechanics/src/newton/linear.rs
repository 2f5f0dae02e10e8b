//! Dense linear equations of a size known at compile time.
//!
//! nalgebra's decompositions of matrices whose size is a type's parameter need bounds on that
//! parameter in every signature above them; these need none, and take numbers that carry derivatives.

use crate::Scalar;

/// `P A = L U`, by Gaussian elimination with row exchanges (Golub and Van Loan, *Matrix
/// Computations*, alg. 3.4.1).
#[derive(Clone, Copy, Debug)]
pub struct Factors<D, const U: usize> {
    /// `L` below the diagonal, `U` on and above it.
    lu: [[D; U]; U],
    /// Row of `A` that became row i.
    order: [usize; U],
    determinant_is_positive: bool,
}

impl<D: Scalar, const U: usize> Factors<D, U> {
    /// Factors a matrix given by rows.
    ///
    /// # Errors
    /// The number of the pivot that is zero, or not finite.
    pub fn new(mut a: [[D; U]; U]) -> Result<Self, usize> {
        let mut order = std::array::from_fn(|i| i);
        let mut determinant_is_positive = true;
        for k in 0..U {
            let mut best = k;
            for i in k + 1..U {
                if a[i][k].re().abs() > a[best][k].re().abs() {
                    best = i;
                }
            }
            a.swap(k, best);
            order.swap(k, best);
            let row = a[k];
            let pivot = row[k].re();
            if !(pivot.abs() > 0.0 && pivot.is_finite()) {
                return Err(k);
            }
            determinant_is_positive ^= (best != k) ^ (pivot < 0.0);
            for i in k + 1..U {
                let factor = a[i][k] / row[k];
                a[i][k] = factor;
                for j in k + 1..U {
                    a[i][j] -= factor * row[j];
                }
            }
        }
        Ok(Self { lu: a, order, determinant_is_positive })
    }

    /// `x` with `A x = b`.
    pub fn solve(&self, b: &[D; U]) -> [D; U] {
        let mut x = self.order.map(|row| b[row]);
        for i in 0..U {
            for j in 0..i {
                let known = x[j];
                x[i] -= self.lu[i][j] * known;
            }
        }
        for i in (0..U).rev() {
            for j in i + 1..U {
                let known = x[j];
                x[i] -= self.lu[i][j] * known;
            }
            x[i] /= self.lu[i][i];
        }
        x
    }

    /// Whether `det A > 0`.
    pub fn determinant_is_positive(&self) -> bool {
        self.determinant_is_positive
    }
}

/// `x` with `A x = b`.
///
/// # Errors
/// The number of the pivot that is zero, or not finite.
pub fn solve_linear<D: Scalar, const U: usize>(a: [[D; U]; U], b: [D; U]) -> Result<[D; U], usize> {
    Ok(Factors::new(a)?.solve(&b))
}

#[cfg(test)]
mod tests {
    use super::Factors;

    #[test]
    fn solutions_and_signs() {
        // det = −2·(−1)·… by hand: rows exchanged once from diag(2, 3, −1) gives +6.
        let a = [[0.0_f64, 3.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, -1.0]];
        let factors = Factors::new(a).expect("regular");
        assert!(factors.determinant_is_positive());
        assert_eq!(factors.solve(&[3.0, 4.0, 5.0]), [2.0, 1.0, -5.0]);
        let b = [[4.0_f64, 1.0], [2.0, 3.0]];
        assert!(Factors::new(b).expect("regular").determinant_is_positive());
        let c = [[1.0_f64, 2.0], [3.0, 4.0]];
        assert!(!Factors::new(c).expect("regular").determinant_is_positive());
        assert_eq!(Factors::new([[1.0_f64, 2.0], [2.0, 4.0]]).err(), Some(1));
        assert_eq!(Factors::new([[f64::NAN]]).err(), Some(0));
    }
}

//! Dense linear equations of a size known at compile time.

/// `x` with `A x = b`, by Gaussian elimination with row exchanges (Golub and Van Loan, *Matrix
/// Computations*, alg. 3.4.1).
///
/// nalgebra's decompositions of matrices whose size is a type's parameter need bounds on that
/// parameter in every signature above them; this needs none.
///
/// # Errors
/// The number of the pivot that is zero, or not finite.
pub fn solve_linear<const U: usize>(
    mut a: [[f64; U]; U],
    mut b: [f64; U],
) -> Result<[f64; U], usize> {
    for k in 0..U {
        let mut best = k;
        for i in k + 1..U {
            if a[i][k].abs() > a[best][k].abs() {
                best = i;
            }
        }
        a.swap(k, best);
        b.swap(k, best);
        let (row, value) = (a[k], b[k]);
        if !(row[k].abs() > 0.0 && row[k].is_finite()) {
            return Err(k);
        }
        for i in k + 1..U {
            let factor = a[i][k] / row[k];
            for j in k..U {
                a[i][j] -= factor * row[j];
            }
            b[i] -= factor * value;
        }
    }
    for i in (0..U).rev() {
        let mut sum = b[i];
        for j in i + 1..U {
            sum -= a[i][j] * b[j];
        }
        b[i] = sum / a[i][i];
    }
    Ok(b)
}

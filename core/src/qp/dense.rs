//! A program whose Hessian and rows are just numbers.

use super::ldl::{Ldl, factor_cost, solution_cost};
use super::{Program, ProgramCost, Search, Work};
use crate::Real;

/// `½ (x − x₀)ᵀ H (x − x₀)` and `A x ≥ b`, for `N` unknowns and `M ≤ 256` rows.
///
/// ```compile_fail
/// use surefoot::qp::{ActiveRows, DenseProgram, Settings, solve};
/// // 257 rows: an error at compile time.
/// let program = DenseProgram {
///     minimum: [0.0],
///     hessian: [[1.0]],
///     normals: [[1.0]; 257],
///     bounds: [0.0; 257],
/// };
/// let _ = solve(&program, &mut ActiveRows::<f64, 4>::new(), &Settings::new(1e-3));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct DenseProgram<T, const N: usize, const M: usize> {
    /// `x₀`. For a linear term instead, `½ xᵀ H x + cᵀ x`, see [`DenseProgram::with_linear_term`].
    pub minimum: [T; N],
    /// `H`, of which the lower triangle is read.
    pub hessian: [[T; N]; N],
    /// Rows of `A`.
    pub normals: [[T; N]; M],
    /// `b`
    pub bounds: [T; M],
}

impl<T: Real, const N: usize, const M: usize> DenseProgram<T, N, M> {
    /// The program `½ xᵀ H x + cᵀ x`, `A x ≥ b`; `None` where H is not positive definite.
    pub fn with_linear_term(
        hessian: [[T; N]; N],
        linear: [T; N],
        normals: [[T; N]; M],
        bounds: [T; M],
    ) -> Option<Self> {
        let minimum = Ldl::new(&hessian)?.solve(&linear.map(|c| -c));
        Some(Self { minimum, hessian, normals, bounds })
    }
}

#[inline(always)]
fn dot<T: Real, const N: usize>(a: &[T; N], b: &[T; N]) -> T {
    a.iter().zip(b).fold(T::zero(), |sum, (a, b)| sum + *a * *b)
}

impl<T: Real, const N: usize, const M: usize> Program<T> for DenseProgram<T, N, M> {
    type Point = [T; N];
    type Normal = [T; N];
    type Factor = Ldl<T, N>;

    const COST: ProgramCost = {
        assert!(M <= 256, "a row's number is one byte");
        ProgramCost {
            factor: factor_cost(N),
            response: solution_cost(N),
            row: N as Work,
            product: N as Work,
            scan: (N * M) as Work,
        }
    };

    #[inline(always)]
    fn minimum(&self) -> [T; N] {
        self.minimum
    }

    #[inline(always)]
    fn zero(&self) -> [T; N] {
        [T::zero(); N]
    }

    #[inline(always)]
    fn moved(&self, x: &[T; N], by: &[T; N]) -> [T; N] {
        core::array::from_fn(|i| x[i] + by[i])
    }

    #[inline(always)]
    fn is_finite(&self, x: &[T; N]) -> bool {
        x.iter().all(|x| x.is_finite())
    }

    #[inline(always)]
    fn factor(&self) -> Option<Ldl<T, N>> {
        Ldl::new(&self.hessian)
    }

    #[inline(always)]
    fn response(&self, factor: &Ldl<T, N>, gradient: &[T; N]) -> [T; N] {
        factor.solve(gradient)
    }

    #[inline(always)]
    fn row(&self, row: u8) -> Option<([T; N], T)> {
        let row = usize::from(row);
        Some((*self.normals.get(row)?, *self.bounds.get(row)?))
    }

    #[inline(always)]
    fn product(&self, normal: &[T; N], x: &[T; N]) -> T {
        dot(normal, x)
    }

    #[inline(always)]
    fn accumulate(&self, gradient: &mut [T; N], normal: &[T; N], multiplier: T) {
        for (g, a) in gradient.iter_mut().zip(normal) {
            *g += *a * multiplier;
        }
    }

    #[inline(always)]
    fn scan(&self, x: &[T; N], search: &mut Search<'_, T>) {
        for (row, (normal, bound)) in (0..=u8::MAX).zip(self.normals.iter().zip(&self.bounds)) {
            search.offer(row, dot(normal, x) - *bound);
        }
    }
}

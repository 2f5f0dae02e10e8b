//! A leg's Jacobian and its factors.
//!
//! # Notation
//! - `S_k = (e_k × (o − q_k), e_k)`: twist of the foot's frame per rate of joint k, axes of frame 1,
//!   taken at the point `o`, the last joint
//! - `J = [S_1 … S_6]`, with rows 1 to 3 in units of the leg's reach, so that all are dimensionless
//! - `P J = L U` with row exchanges (Golub and Van Loan, *Matrix Computations*, alg. 3.4.1)

use super::LegKinematics;
use super::robot::LEG;
use crate::Real;
use crate::spatial::{Twist, Wrench};

/// `J`, factored.
#[derive(Clone, Copy, Debug)]
pub struct LegJacobian<T> {
    /// Unit lower triangle `L` below the diagonal, `U` on and above it, by rows.
    factors: [[T; LEG]; LEG],
    /// Row of `J` that became row i.
    order: [usize; LEG],
    inverse_pivots: [T; LEG],
    inverse_reach: T,
}

impl<T: Real> LegJacobian<T> {
    /// Factors the Jacobian of a leg whose reach is `reach` (m); `None` where a pivot is smaller
    /// than `singularity` (or is NaN).
    #[inline(always)]
    pub fn new(leg: &LegKinematics<T>, reach: T, singularity: T) -> Option<Self> {
        let inverse_reach = T::one() / reach;
        let mut rows = [[T::zero(); LEG]; LEG];
        let o = leg.origins[LEG - 1];
        for k in 0..LEG {
            let e = leg.axes[k];
            let linear = e.cross(&(o - leg.origins[k])) * inverse_reach;
            let column = [linear.x, linear.y, linear.z, e.x, e.y, e.z];
            for i in 0..LEG {
                rows[i][k] = column[i];
            }
        }
        Self::factor(rows, singularity, inverse_reach)
    }

    #[inline(always)]
    fn factor(rows: [[T; LEG]; LEG], singularity: T, inverse_reach: T) -> Option<Self> {
        let mut lu = Self {
            factors: rows,
            order: [0, 1, 2, 3, 4, 5],
            inverse_pivots: [T::zero(); LEG],
            inverse_reach,
        };
        // One by one, so that all bounds of the loops inside are constants.
        lu.eliminate::<0>(singularity)?;
        lu.eliminate::<1>(singularity)?;
        lu.eliminate::<2>(singularity)?;
        lu.eliminate::<3>(singularity)?;
        lu.eliminate::<4>(singularity)?;
        lu.eliminate::<5>(singularity)?;
        Some(lu)
    }

    /// Brings the largest of column `K` to the diagonal, and eliminates what is below it.
    #[inline(always)]
    fn eliminate<const K: usize>(&mut self, singularity: T) -> Option<()> {
        let rows = &mut self.factors;
        let mut best = K;
        let mut size = rows[K][K].abs();
        for i in K + 1..LEG {
            let candidate = rows[i][K].abs();
            if candidate > size {
                best = i;
                size = candidate;
            }
        }
        // NaN compares as false.
        if !(size > singularity) {
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
        for i in K + 1..LEG {
            let factor = rows[i][K] * inverse;
            rows[i][K] = factor;
            for j in K + 1..LEG {
                rows[i][j] -= factor * pivot_row[j];
            }
        }
        Some(())
    }

    /// Joint rates `x` with `J x = V`, for a twist in frame 1's axes at the last joint.
    #[inline(always)]
    pub fn solve(&self, twist: Twist<T>) -> [T; LEG] {
        let linear = twist.linear * self.inverse_reach;
        let w = twist.angular;
        let b = [linear.x, linear.y, linear.z, w.x, w.y, w.z];
        let mut x = [T::zero(); LEG];
        for i in 0..LEG {
            let mut sum = b.get(self.order[i]).copied().unwrap_or(T::zero());
            for j in 0..i {
                sum -= self.factors[i][j] * x[j];
            }
            x[i] = sum;
        }
        for i in (0..LEG).rev() {
            let mut sum = x[i];
            for j in i + 1..LEG {
                sum -= self.factors[i][j] * x[j];
            }
            x[i] = sum * self.inverse_pivots[i];
        }
        x
    }

    /// The wrench `F` with `Jᵀ F = t`, in frame 1's axes at the last joint.
    #[inline(always)]
    pub fn solve_transposed(&self, t: &[T; LEG]) -> Wrench<T> {
        let mut y = *t;
        for i in 0..LEG {
            let mut sum = y[i];
            for j in 0..i {
                sum -= self.factors[j][i] * y[j];
            }
            y[i] = sum * self.inverse_pivots[i];
        }
        for i in (0..LEG).rev() {
            let mut sum = y[i];
            for j in i + 1..LEG {
                sum -= self.factors[j][i] * y[j];
            }
            y[i] = sum;
        }
        let mut f = [T::zero(); LEG];
        for i in 0..LEG {
            if let Some(entry) = f.get_mut(self.order[i]) {
                *entry = y[i];
            }
        }
        let wrench = Wrench::from_array(f);
        // Rows 1 to 3 of J were divided by the reach: so is the force.
        Wrench { force: wrench.force * self.inverse_reach, torque: wrench.torque }
    }
}

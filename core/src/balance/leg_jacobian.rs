//! A leg's Jacobian and its factors.
//!
//! # Notation
//! - `S_k = (e_k × (o − q_k), e_k)`: twist of the foot's frame per rate of joint k, axes of frame 1,
//!   taken at the point `o`, the last joint
//! - `J = [S_1 … S_6]`, with rows 1 to 3 in units of the leg's reach, so that all are dimensionless

use super::LegKinematics;
use super::robot::LEG;
use super::square::Square;
use crate::Real;
use crate::spatial::{Twist, Wrench};

/// `J`, factored.
#[derive(Clone, Copy, Debug)]
pub struct LegJacobian<T> {
    factors: Square<T>,
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
        Some(Self { factors: Square::new(rows, singularity)?, inverse_reach })
    }

    /// Joint rates `x` with `J x = V`, for a twist in frame 1's axes at the last joint.
    #[inline(always)]
    pub fn solve(&self, twist: Twist<T>) -> [T; LEG] {
        let linear = twist.linear * self.inverse_reach;
        let w = twist.angular;
        self.factors.solve(&[linear.x, linear.y, linear.z, w.x, w.y, w.z])
    }

    /// The wrench `F` with `Jᵀ F = t`, in frame 1's axes at the last joint.
    #[inline(always)]
    pub fn solve_transposed(&self, t: &[T; LEG]) -> Wrench<T> {
        let wrench = Wrench::from_array(self.factors.solve_transposed(t));
        // Rows 1 to 3 of J were divided by the reach: so is the force.
        Wrench { force: wrench.force * self.inverse_reach, torque: wrench.torque }
    }
}

//! The Hessian of the foot wrenches, and how its inverse acts.
//!
//! # Notation
//! Frame 1. `e_i = (f_i, n_i)`: gradient on foot i, about its reference point; `c`, `d_i`, N, S, K of
//! the least-norm split; `C: (f, m) ↦ (f, m + c × f)`, from the feet's mean to the body's origin.
//! ```text
//! H = Gᵀ Q G + ε R,     Q = R̄₀₁ᵀ diag(ω²) R̄₀₁                              (1)
//! H⁻¹ = (1/ε) (R⁻¹ − R⁻¹ Gᵀ K⁻¹ G R⁻¹) + R⁻¹ Gᵀ K⁻¹ (Cᵀ Q C + ε K⁻¹)⁻¹ K⁻¹ G R⁻¹    (2)
//! ```
//! with G about the feet's mean in (2). The first term moves load between the feet and leaves the
//! wrench on the body alone, the second changes that wrench in the cheapest manner: with one foot
//! only the second is there. Kept apart, they are sound in f32, where a Hessian of all unknowns is
//! not (its condition grows as 1/ε). One 6 × 6 factorisation serves any number of feet.

use super::super::least_norm::LeastNorm;
use super::{ContactFoot, ContactWeights};
use crate::Real;
use crate::qp::Ldl;
use crate::spatial::{SymmetricMatrix3, Wrench};
use nalgebra::{Matrix3, Vector3};

/// `Cᵀ Q C + ε K⁻¹`, factored.
#[derive(Clone, Copy, Debug)]
pub struct Metric<T> {
    factors: Ldl<T, 6>,
    inverse_regularization: T,
}

impl<T: Real> Metric<T> {
    /// `None` where the task's weights leave a direction free, or a number is not finite.
    #[inline(always)]
    pub(super) fn new<const FEET: usize>(
        weights: &ContactWeights<T>,
        world: &Matrix3<T>,
        split: &LeastNorm<T, FEET>,
    ) -> Option<Self> {
        let rotated = |w: [T; 3]| {
            let axis = |k: usize| Vector3::new(world[(k, 0)], world[(k, 1)], world[(k, 2)]);
            (0..3).fold(SymmetricMatrix3::zero(), |sum, k| {
                sum + SymmetricMatrix3::outer(axis(k)).scaled(w[k] * w[k])
            })
        };
        let [fx, fy, fz, mx, my, mz] = weights.task;
        let forces = rotated([fx, fy, fz]).to_matrix();
        let moments = rotated([mx, my, mz]).to_matrix();
        // Q_m ĉ, row by row: (q × c)ᵀ; and ĉᵀ Q_m ĉ, column by column.
        let c = split.center;
        let epsilon = weights.regularization;
        let inverse = split.inverse.scaled(epsilon).to_matrix();
        let mut matrix = [[T::zero(); 6]; 6];
        let mut mixed = Matrix3::zeros();
        for i in 0..3 {
            let row = Vector3::new(moments[(i, 0)], moments[(i, 1)], moments[(i, 2)]).cross(&c);
            for j in 0..3 {
                mixed[(i, j)] = row[j];
                matrix[3 + i][j] = row[j];
                matrix[3 + i][3 + j] = moments[(i, j)] + inverse[(i, j)];
            }
        }
        for j in 0..3 {
            let column: Vector3<T> = mixed.column(j).into();
            let column = column.cross(&c);
            for i in 0..3 {
                matrix[i][j] = forces[(i, j)] + column[i];
            }
            matrix[j][j] += epsilon * split.share;
        }
        Some(Self { factors: Ldl::new(&matrix)?, inverse_regularization: T::one() / epsilon })
    }

    /// `H⁻¹ e` by (2).
    #[inline(always)]
    pub(super) fn response<const FEET: usize, const JOINTS: usize>(
        &self,
        feet: &[Option<ContactFoot<'_, T, JOINTS>>; FEET],
        split: &LeastNorm<T, FEET>,
        norm_squared: T,
        gradient: &[Wrench<T>; FEET],
    ) -> [Wrench<T>; FEET] {
        // G R⁻¹ e
        let mut force = Vector3::zeros();
        let mut moment = Vector3::zeros();
        let mut free = [Vector3::zeros(); FEET];
        let mut several = false;
        let mut count = 0_u32;
        for (((foot, arm), e), free) in feet.iter().zip(&split.arms).zip(gradient).zip(&mut free) {
            if let (Some(foot), Some(arm)) = (foot, arm) {
                *free = foot.free_moment(e.torque) * norm_squared;
                force += e.force;
                moment += arm.cross(&e.force) + *free;
                count += 1;
                several |= !foot.limits.patch.is_sole();
            }
        }
        several |= count > 1;
        // K⁻¹ of it, and the right side of H⁻¹'s two terms.
        let y = Wrench { force: force * split.share, torque: split.inverse.product(moment) };
        let t = Wrench::from_array(self.factors.solve(&y.to_array()));
        let mut u =
            Wrench { force: t.force * split.share, torque: split.inverse.product(t.torque) };
        if several {
            u -= y * self.inverse_regularization;
        }
        let mut response = [Wrench::zero(); FEET];
        for ((((to, foot), arm), e), free) in
            response.iter_mut().zip(feet).zip(&split.arms).zip(gradient).zip(&free)
        {
            if let (Some(foot), Some(arm)) = (foot, arm) {
                *to = Wrench {
                    force: u.force + u.torque.cross(arm),
                    torque: foot.free_moment(u.torque) * norm_squared,
                };
                if several {
                    to.force += e.force * self.inverse_regularization;
                    to.torque += *free * self.inverse_regularization;
                }
            }
        }
        response
    }

    /// The same of a gradient on one foot.
    #[inline(always)]
    pub(super) fn row_response<const FEET: usize, const JOINTS: usize>(
        &self,
        feet: &[Option<ContactFoot<'_, T, JOINTS>>; FEET],
        split: &LeastNorm<T, FEET>,
        norm_squared: T,
        (own, e): (usize, &Wrench<T>),
    ) -> [Wrench<T>; FEET] {
        let (Some(Some(foot)), Some(Some(arm))) = (feet.get(own), split.arms.get(own)) else {
            return [Wrench::zero(); FEET];
        };
        let free = foot.free_moment(e.torque) * norm_squared;
        let moment = arm.cross(&e.force) + free;
        let y = Wrench { force: e.force * split.share, torque: split.inverse.product(moment) };
        let t = Wrench::from_array(self.factors.solve(&y.to_array()));
        let mut u =
            Wrench { force: t.force * split.share, torque: split.inverse.product(t.torque) };
        let several = feet.iter().flatten().count() > 1
            || feet.iter().flatten().any(|f| !f.limits.patch.is_sole());
        if several {
            u -= y * self.inverse_regularization;
        }
        core::array::from_fn(|i| {
            let (Some(foot), Some(arm)) = (&feet[i], &split.arms[i]) else {
                return Wrench::zero();
            };
            let mut to = Wrench {
                force: u.force + u.torque.cross(arm),
                torque: foot.free_moment(u.torque) * norm_squared,
            };
            if several && i == own {
                to.force += e.force * self.inverse_regularization;
                to.torque += free * self.inverse_regularization;
            }
            to
        })
    }
}

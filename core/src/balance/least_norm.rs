//! Wrenches of least norm on feet that add up to a given one.
//!
//! # Notation
//! Frame 1; foot i at `p_i`, `c` their mean, `d_i = p_i − c`, N the number of feet. The norm counts a
//! moment as a force at the length ℓ:  `‖w‖² = Σ |f_i|² + |n_i|²/ℓ²`;  the printed one has ℓ = 1 m.
//!
//! `K = G R⁻¹ Gᵀ` (R the norm's matrix) does not depend on how the feet are turned, and seen from `c`
//! it falls into two blocks, `N` for forces and
//! ```text
//! S = N ℓ² 1 + Σ d̂_i d̂_iᵀ = N ℓ² 1 + Σ (|d_i|² 1 − d_i d_iᵀ)                (1)
//! ```
//! for moments. So the pseudo-inverse is one symmetric 3 × 3 solve:
//! ```text
//! S y = τ − c × f,    n_i = ℓ² y,    f_i = f/N − d_i × y                     (2)
//! ```
//! (Sum: `Σ f_i = f`, as `Σ d_i = 0`; `Σ (n_i + p_i × f_i) = c × f + S y = τ`.)

use crate::Real;
use crate::spatial::{SymmetricMatrix3, Wrench};
use nalgebra::Vector3;

/// Where the feet are, and the inverse of (1).
#[derive(Clone, Copy, Debug)]
pub(super) struct LeastNorm<T, const FEET: usize> {
    /// `c`
    pub center: Vector3<T>,
    /// `d_i`; `None` for a foot that takes no part.
    pub arms: [Option<Vector3<T>>; FEET],
    /// `1/N`
    pub share: T,
    /// `S⁻¹`
    pub inverse: SymmetricMatrix3<T>,
}

impl<T: Real, const FEET: usize> LeastNorm<T, FEET> {
    /// For feet at these positions. `moments` is the first term of (1). `None` where there is no
    /// foot, or where feet are so far away that (1) overflows.
    #[inline(always)]
    pub fn new(
        positions: [Option<Vector3<T>>; FEET],
        moments: SymmetricMatrix3<T>,
    ) -> Option<Self> {
        let feet = || positions.iter().flatten();
        let share = T::one() / feet().fold(T::zero(), |count, _| count + T::one());
        let center = feet().fold(Vector3::zeros(), |sum, p| sum + p) * share;
        let arms = positions.map(|p| p.map(|p| p - center));
        let s = arms.iter().flatten().fold(moments, |s, d| {
            s + SymmetricMatrix3::scalar(d.norm_squared()) - SymmetricMatrix3::outer(*d)
        });
        Some(Self { center, arms, share, inverse: s.inverse()? })
    }

    /// `y` of (2) and the forces `f_i`, for a wrench in frame 1.
    #[inline(always)]
    pub fn forces(&self, wrench: Wrench<T>) -> (Vector3<T>, [Option<Vector3<T>>; FEET]) {
        let y = self.inverse.product(wrench.torque - self.center.cross(&wrench.force));
        (y, self.arms.map(|d| d.map(|d| wrench.force * self.share - d.cross(&y))))
    }
}

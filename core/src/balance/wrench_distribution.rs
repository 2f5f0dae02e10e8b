//! Algorithm 4.5: the desired wrench as a sum of foot wrenches of least norm.
//!
//! # Notation
//! Frame 1; `p_i` centre of mass of foot i, `c` their mean, `d_i = p_i − c`, N the number of feet.
//!
//! `G Gᵀ` of (4.29) does not depend on how the feet are turned, and seen from `c` it falls into two
//! blocks, `N` for forces and
//! ```text
//! S = N 1 + Σ d̂_i d̂_iᵀ = N 1 + Σ (|d_i|² 1 − d_i d_iᵀ)                     (1)
//! ```
//! for moments. So the pseudo-inverse is one symmetric 3 × 3 solve:
//! ```text
//! S y = τ − c × f,    n_i = y,    f_i = f/N − d_i × y                       (2)
//! ```
//! (Sum: `Σ f_i = f`, as `Σ d_i = 0`; `Σ (n_i + p_i × f_i) = c × f + S y = τ`.) The printed norm adds
//! squared newtons to squared newton-metres; it is kept.

use super::LegKinematics;
use crate::Real;
use crate::spatial::{SymmetricMatrix3, Wrench};
use nalgebra::Vector3;

/// The wrenches asked of the feet, from [`wrench_distribution`].
#[derive(Clone, Copy, Debug)]
pub struct FootWrenches<T, const LEGS: usize> {
    /// On each foot from the ground, at the foot's centre of mass, in frame 1's axes.
    pub in_central_axes: [Wrench<T>; LEGS],
    /// `F_l`, `F_r`: the same in the feet's body frames.
    pub in_foot_frames: [Wrench<T>; LEGS],
}

/// Alg. 4.5 for the wrench `desired` on the central body, in its frame. `None` where the feet are so
/// far away that (1) overflows.
#[inline(always)]
pub fn wrench_distribution<T: Real, const LEGS: usize>(
    desired: Wrench<T>,
    legs: &[LegKinematics<T>; LEGS],
) -> Option<FootWrenches<T, LEGS>> {
    let share = T::one() / T::of(LEGS as f64);
    let center = legs.iter().fold(Vector3::zeros(), |sum, leg| sum + leg.foot.position) * share;
    // (1)
    let s = legs.iter().fold(SymmetricMatrix3::scalar(T::of(LEGS as f64)), |s, leg| {
        let d = leg.foot.position - center;
        s + SymmetricMatrix3::scalar(d.norm_squared()) - SymmetricMatrix3::outer(d)
    });
    let moment = desired.torque - center.cross(&desired.force);
    let y = s.inverse()?.product(moment);
    // (2)
    let in_central_axes: [Wrench<T>; LEGS] = legs.each_ref().map(|leg| Wrench {
        force: desired.force * share - (leg.foot.position - center).cross(&y),
        torque: y,
    });
    let mut in_foot_frames = in_central_axes;
    for (wrench, leg) in in_foot_frames.iter_mut().zip(legs) {
        *wrench = Wrench {
            force: leg.foot.rotation.tr_mul(&wrench.force),
            torque: leg.foot.rotation.tr_mul(&wrench.torque),
        };
    }
    Some(FootWrenches { in_central_axes, in_foot_frames })
}

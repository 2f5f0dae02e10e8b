//! Algorithm 4.6: joint torques that make the feet push as asked.
//!
//! The recursion of the text carries a wrench outboard unchanged and projects it on each axis; in one
//! frame that is a product per joint: with the wrench `(f, n)` on the foot at `p`,
//! ```text
//! τ_k = −e_k · (n + (p − q_k) × f)
//! ```
//! The links themselves are taken as at rest and weightless here, as in the text: their dynamics are
//! in `P_1` and `z_1`.

use super::LegKinematics;
use super::robot::LEG;
use crate::Real;
use crate::spatial::Wrench;

/// Alg. 4.6 for one leg: torques (N·m) for the wrench of the ground on the foot, at its centre of
/// mass, in frame 1's axes.
#[inline(always)]
pub fn joint_torques<T: Real>(leg: &LegKinematics<T>, foot: Wrench<T>) -> [T; LEG] {
    let p = leg.foot.position;
    let mut torques = [T::zero(); LEG];
    for ((torque, e), q) in torques.iter_mut().zip(&leg.axes).zip(&leg.origins) {
        *torque = -e.dot(&foot.shifted(p - q).torque);
    }
    torques
}

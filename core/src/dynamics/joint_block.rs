//! `U = P H` and `D = Hᵀ U` of a joint with several degrees of freedom (3.51), (3.59).

use super::joint_motion::JointMotion;
use crate::Real;
use crate::spatial::{ArticulatedInertia, Wrench};

/// `U` and the factors `D = L E Lᵀ` of a joint with up to six degrees of freedom.
pub(super) struct JointBlock<T> {
    pub images: [Wrench<T>; 6],
    /// Strictly lower triangle of `L`.
    pub lower: [[T; 6]; 6],
    /// `E⁻¹`; zero beyond the joint's degrees of freedom.
    pub inverse: [T; 6],
    degrees_of_freedom: usize,
}

impl<T: Real> JointBlock<T> {
    /// `None` where `D` is not positive definite.
    #[inline]
    pub fn new(p: &ArticulatedInertia<T>, motion: &JointMotion<T>) -> Option<Self> {
        let zero = T::zero();
        let degrees_of_freedom = motion.degrees_of_freedom.min(6);
        let mut images = [Wrench::zero(); 6];
        let mut lower = [[zero; 6]; 6];
        let mut inverse = [zero; 6];
        let mut pivots = [zero; 6];
        for i in 0..degrees_of_freedom {
            images[i] = p.product(motion.map[i]);
            let mut pivot = motion.map[i].power(images[i]);
            for j in 0..i {
                let mut sum = motion.map[i].power(images[j]);
                for (m, e) in pivots.iter().enumerate().take(j) {
                    sum -= lower[i][m] * lower[j][m] * *e;
                }
                let l = sum * inverse[j];
                lower[i][j] = l;
                pivot -= l * l * pivots[j];
            }
            if !(pivot > zero) {
                return None;
            }
            pivots[i] = pivot;
            inverse[i] = T::one() / pivot;
        }
        Some(Self { images, lower, inverse, degrees_of_freedom })
    }

    /// `x ← D⁻¹ x`.
    #[inline]
    pub fn solve(&self, x: &mut [T; 6]) {
        // Said again for the compiler, which then leaves out the checks of bounds.
        let degrees_of_freedom = self.degrees_of_freedom.min(6);
        for i in 0..degrees_of_freedom {
            for j in 0..i {
                x[i] -= self.lower[i][j] * x[j];
            }
        }
        for i in (0..degrees_of_freedom).rev() {
            x[i] *= self.inverse[i];
            for j in i + 1..degrees_of_freedom {
                x[i] -= self.lower[j][i] * x[j];
            }
        }
    }
}

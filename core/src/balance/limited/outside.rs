//! What acts on the central body from outside: a wrench that may be known, or none ever, which costs nothing.

use crate::Real;
use crate::spatial::Wrench;
use nalgebra::Matrix3;

/// Either.
pub(super) trait Outside<T>: Copy {
    /// From world axes to those of the central body.
    fn in_frame_1(self, central: &Matrix3<T>) -> Self;

    /// What the feet are asked for where both together are to be `desired`.
    fn less(self, desired: Wrench<T>) -> Wrench<T>;
}

impl<T: Real> Outside<T> for () {
    #[inline(always)]
    fn in_frame_1(self, _: &Matrix3<T>) {}

    #[inline(always)]
    fn less(self, desired: Wrench<T>) -> Wrench<T> {
        desired
    }
}

impl<T: Real> Outside<T> for Option<Wrench<T>> {
    #[inline(always)]
    fn in_frame_1(self, central: &Matrix3<T>) -> Self {
        self.map(|w| Wrench { force: central.tr_mul(&w.force), torque: central.tr_mul(&w.torque) })
    }

    #[inline(always)]
    fn less(self, desired: Wrench<T>) -> Wrench<T> {
        self.map_or(desired, |w| desired - w)
    }
}

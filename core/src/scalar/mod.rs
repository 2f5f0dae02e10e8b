//! The scalar of every algorithm: `f32` on the microcontroller, `f64` on the host.

mod sine_cosine;

use crate::dynamics::lanes::Lanes;
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
use crate::dynamics::pair::Pair;
use crate::model::{GeneralJoint, GeneralMotion};

mod sealed {
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}

/// A floating-point scalar: `f32` or `f64`, and nothing else.
///
/// Arithmetic, `sqrt` and `atan2` come from [`nalgebra::RealField`], which is built here on `libm`
/// for host and target alike. Sine and cosine are our own ([`Real::sine_cosine`]), made of plain
/// additions and multiplications. Both choices make the same source give the same bits everywhere.
pub trait Real: nalgebra::RealField + Copy + sealed::Sealed {
    /// Two of it in one register, or itself where the processor has none for two.
    #[doc(hidden)]
    type Pair: Lanes<Scalar = Self>;

    /// The nearest scalar to a constant.
    fn of(constant: f64) -> Self;

    /// `(sin x, cos x)`, x in radians.
    ///
    /// Error: at most 1 ulp (f64) and 1 ulp (f32) of 1 for |x| ≤ 10⁵ (f64) or 8000 (f32), the range
    /// of any joint; beyond it, `libm`. Cost: about 30 operations and no branch on the value within
    /// that range. Not finite in, NaN out.
    fn sine_cosine(self) -> (Self, Self);

    /// Whether [`Real::near_sine_cosine`] is what [`Real::sine_cosine`] gives.
    #[doc(hidden)]
    fn is_near(self) -> bool;

    /// [`Real::sine_cosine`] without a branch, for loops; of no meaning where not [`Real::is_near`].
    #[doc(hidden)]
    fn near_sine_cosine(self) -> (Self, Self);

    /// The value as `f64`, for reports.
    fn to_f64(self) -> f64;

    /// Evaluates a user's joint in this precision.
    #[doc(hidden)]
    fn general_motion(
        joint: &GeneralJoint,
        positions: &[Self; 7],
        velocities: &[Self; 6],
    ) -> GeneralMotion<Self>;
}

impl Real for f32 {
    #[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
    type Pair = Pair<wide::f32x4>;
    #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
    type Pair = Self;
    #[inline(always)]
    fn of(constant: f64) -> Self {
        constant as f32
    }
    #[inline]
    fn sine_cosine(self) -> (Self, Self) {
        sine_cosine::f32(self)
    }
    #[inline(always)]
    fn is_near(self) -> bool {
        sine_cosine::is_near_f32(self)
    }
    #[inline(always)]
    fn near_sine_cosine(self) -> (Self, Self) {
        sine_cosine::near_f32(self)
    }
    #[inline(always)]
    fn to_f64(self) -> f64 {
        f64::from(self)
    }
    #[inline]
    fn general_motion(
        joint: &GeneralJoint,
        positions: &[Self; 7],
        velocities: &[Self; 6],
    ) -> GeneralMotion<Self> {
        (joint.motion_f32)(positions, velocities)
    }
}

impl Real for f64 {
    #[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
    type Pair = Pair<wide::f64x2>;
    #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
    type Pair = Self;
    #[inline(always)]
    fn of(constant: f64) -> Self {
        constant
    }
    #[inline]
    fn sine_cosine(self) -> (Self, Self) {
        sine_cosine::f64(self)
    }
    #[inline(always)]
    fn is_near(self) -> bool {
        sine_cosine::is_near_f64(self)
    }
    #[inline(always)]
    fn near_sine_cosine(self) -> (Self, Self) {
        sine_cosine::near_f64(self)
    }
    #[inline(always)]
    fn to_f64(self) -> f64 {
        self
    }
    #[inline]
    fn general_motion(
        joint: &GeneralJoint,
        positions: &[Self; 7],
        velocities: &[Self; 6],
    ) -> GeneralMotion<Self> {
        (joint.motion_f64)(positions, velocities)
    }
}

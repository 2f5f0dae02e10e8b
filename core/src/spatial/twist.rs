//! Twists: velocities and accelerations of frames (Appendix A.5).

use super::Wrench;
use crate::Real;
use core::ops::{Add, Mul, Neg, Sub};
use nalgebra::Vector3;

/// A twist `(v, ω)`. As a velocity: `v` of the frame's origin (m/s) and `ω` (rad/s), in that frame.
/// As an acceleration: the time derivatives of these components.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Twist<T> {
    /// `v`
    pub linear: Vector3<T>,
    /// `ω`
    pub angular: Vector3<T>,
}

impl<T: Real> Twist<T> {
    /// At rest.
    #[inline]
    pub fn zero() -> Self {
        Self { linear: Vector3::zeros(), angular: Vector3::zeros() }
    }

    /// From `[v, ω]`, linear part first.
    #[inline]
    pub fn from_array([a, b, c, d, e, f]: [T; 6]) -> Self {
        Self { linear: Vector3::new(a, b, c), angular: Vector3::new(d, e, f) }
    }

    /// As `[v, ω]`, linear part first.
    #[inline]
    pub fn to_array(self) -> [T; 6] {
        let (v, w) = (self.linear, self.angular);
        [v.x, v.y, v.z, w.x, w.y, w.z]
    }

    /// Power (W) of a wrench in the same frame: `fᵀv + τᵀω`.
    #[inline]
    pub fn power(self, wrench: Wrench<T>) -> T {
        self.linear.dot(&wrench.force) + self.angular.dot(&wrench.torque)
    }

    /// `ad_V W = (ω × w_v + v × w_ω, ω × w_ω)`, the Lie bracket; with `W = Hβ` of a joint whose map
    /// is constant, the velocity-product acceleration `a_k`.
    #[inline]
    pub fn bracket(self, other: Self) -> Self {
        Self {
            linear: self.angular.cross(&other.linear) + self.linear.cross(&other.angular),
            angular: self.angular.cross(&other.angular),
        }
    }

    /// Whether all six numbers are finite.
    #[inline]
    pub fn is_finite(self) -> bool {
        self.to_array().iter().all(|x| x.is_finite())
    }
}

impl<T: Real> Add for Twist<T> {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self { linear: self.linear + other.linear, angular: self.angular + other.angular }
    }
}

impl<T: Real> Sub for Twist<T> {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        Self { linear: self.linear - other.linear, angular: self.angular - other.angular }
    }
}

impl<T: Real> Neg for Twist<T> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { linear: -self.linear, angular: -self.angular }
    }
}

impl<T: Real> Mul<T> for Twist<T> {
    type Output = Self;
    #[inline]
    fn mul(self, factor: T) -> Self {
        Self { linear: self.linear * factor, angular: self.angular * factor }
    }
}

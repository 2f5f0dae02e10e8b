//! Wrenches: forces and torques on frames (Appendix A.7).

use crate::Real;
use core::ops::{Add, AddAssign, Mul, Neg, Sub, SubAssign};
use nalgebra::Vector3;

/// A wrench `(f, τ)`: force (N) and torque (N·m) about the frame's origin, in that frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench<T> {
    /// `f`
    pub force: Vector3<T>,
    /// `τ`
    pub torque: Vector3<T>,
}

impl<T: Real> Wrench<T> {
    /// Nothing acts.
    #[inline]
    pub fn zero() -> Self {
        Self { force: Vector3::zeros(), torque: Vector3::zeros() }
    }

    /// From `[f, τ]`, force first.
    #[inline]
    pub fn from_array([a, b, c, d, e, f]: [T; 6]) -> Self {
        Self { force: Vector3::new(a, b, c), torque: Vector3::new(d, e, f) }
    }

    /// As `[f, τ]`, force first.
    #[inline]
    pub fn to_array(self) -> [T; 6] {
        let (f, t) = (self.force, self.torque);
        [f.x, f.y, f.z, t.x, t.y, t.z]
    }

    /// The same wrench, its torque taken about a point from which this frame's origin lies at `arm`
    /// (m); axes unchanged.
    #[inline]
    pub fn shifted(self, arm: Vector3<T>) -> Self {
        Self { force: self.force, torque: self.torque + arm.cross(&self.force) }
    }

    /// Whether all six numbers are finite.
    #[inline]
    pub fn is_finite(self) -> bool {
        self.to_array().iter().all(|x| x.is_finite())
    }
}

impl<T: Real> Add for Wrench<T> {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self { force: self.force + other.force, torque: self.torque + other.torque }
    }
}

impl<T: Real> AddAssign for Wrench<T> {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        self.force += other.force;
        self.torque += other.torque;
    }
}

impl<T: Real> Sub for Wrench<T> {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        Self { force: self.force - other.force, torque: self.torque - other.torque }
    }
}

impl<T: Real> SubAssign for Wrench<T> {
    #[inline]
    fn sub_assign(&mut self, other: Self) {
        self.force -= other.force;
        self.torque -= other.torque;
    }
}

impl<T: Real> Neg for Wrench<T> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { force: -self.force, torque: -self.torque }
    }
}

impl<T: Real> Mul<T> for Wrench<T> {
    type Output = Self;
    #[inline]
    fn mul(self, factor: T) -> Self {
        Self { force: self.force * factor, torque: self.torque * factor }
    }
}

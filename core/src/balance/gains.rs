//! The controller's gains, and how to make others of them.

use crate::Real;
use crate::spatial::SymmetricMatrix3;
use core::ops::{Add, Mul};

/// Gain matrices of §4.2.4, symmetric and positive definite. All are gains from an error to an
/// acceleration: they do not depend on the robot.
///
/// ```
/// use surefoot::balance::Gains;
///
/// let printed = Gains::<f32>::experiments();
/// let quick = printed.faster(1.5); // errors go in two thirds of the time, damped alike
/// let softer = printed * 0.5; // half of each gain
/// let between = printed * 0.75 + quick * 0.25; // a quarter of the way to the quick ones
/// assert!(between.position.to_matrix()[(2, 2)] > printed.position.to_matrix()[(2, 2)]);
/// # let _ = softer;
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gains<T> {
    /// `K_c^p`, 1/s²
    pub position: SymmetricMatrix3<T>,
    /// `K_c^v`, 1/s
    pub velocity: SymmetricMatrix3<T>,
    /// `K_R^p`, 1/s², on `sin(θ_e/2)`
    pub orientation: SymmetricMatrix3<T>,
    /// `K_R^v`, 1/s
    pub angular_velocity: SymmetricMatrix3<T>,
}

impl<T: Real> Gains<T> {
    /// The gains of both experiments of §4.3.
    pub fn experiments() -> Self {
        let numbers: [[f64; 3]; 4] =
            [[50.0, 50.0, 200.0], [7.07, 7.07, 14.142], [50.0; 3], [7.07; 3]];
        Self::diagonal(numbers.map(|axes| axes.map(T::of)))
    }

    /// Each axis of the world by itself: x, y, z of position (1/s²), velocity (1/s), orientation (1/s²) and angular
    /// velocity (1/s).
    pub fn diagonal(axes: [[T; 3]; 4]) -> Self {
        let [position, velocity, orientation, angular_velocity] =
            axes.map(|[x, y, z]| SymmetricMatrix3::diagonal(x, y, z));
        Self { position, velocity, orientation, angular_velocity }
    }

    /// Gains by which errors go `factor` times as fast with the same damping: `ë + K^v ė + K^p e = 0` has its roots
    /// times `f` where `K^p` is taken times `f²` and `K^v` times `f`.
    ///
    /// Torques of a given error grow with `factor²`; at a given rate of ticks there is a largest one
    /// (`docs/tuning.md`).
    pub fn faster(&self, factor: T) -> Self {
        let squared = factor * factor;
        Self {
            position: self.position.scaled(squared),
            velocity: self.velocity.scaled(factor),
            orientation: self.orientation.scaled(squared),
            angular_velocity: self.angular_velocity.scaled(factor),
        }
    }
}

/// Every gain times a number.
impl<T: Real> Mul<T> for Gains<T> {
    type Output = Self;

    fn mul(self, factor: T) -> Self {
        Self {
            position: self.position.scaled(factor),
            velocity: self.velocity.scaled(factor),
            orientation: self.orientation.scaled(factor),
            angular_velocity: self.angular_velocity.scaled(factor),
        }
    }
}

/// Gain by gain. Sums of positive definite gains are such, and with them all mixtures.
impl<T: Real> Add for Gains<T> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            position: self.position + other.position,
            velocity: self.velocity + other.velocity,
            orientation: self.orientation + other.orientation,
            angular_velocity: self.angular_velocity + other.angular_velocity,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Roots of `s² + k s + p`, real and imaginary part of the one with the larger.
    fn roots<T: Real>(p: T, k: T) -> (T, T) {
        let half = k * T::of(0.5);
        let under = p - half * half;
        if under > T::zero() { (-half, under.sqrt()) } else { ((-under).sqrt() - half, T::zero()) }
    }

    /// By the closed form of the roots; measured 0 in f64, 1e-7 in f32.
    fn faster_gains_scale_the_roots<T: Real>(tolerance: f64) {
        let gains = Gains::<T>::experiments();
        for factor in [0.25, 0.8, 1.7, 3.0].map(T::of) {
            let quick = gains.faster(factor);
            for (p, k, of_p, of_k) in [
                (gains.position, gains.velocity, quick.position, quick.velocity),
                (
                    gains.orientation,
                    gains.angular_velocity,
                    quick.orientation,
                    quick.angular_velocity,
                ),
            ] {
                for axis in 0..3 {
                    let at = |m: &SymmetricMatrix3<T>| m.to_matrix()[(axis, axis)];
                    let (real, imaginary) = roots(at(&p), at(&k));
                    let (quick_real, quick_imaginary) = roots(at(&of_p), at(&of_k));
                    let size = (real * real + imaginary * imaginary).sqrt() * factor;
                    let off = (quick_real - real * factor).abs()
                        + (quick_imaginary - imaginary * factor).abs();
                    assert!((off / size).to_f64() <= tolerance, "{off:?} of {size:?}");
                }
            }
        }
    }

    #[test]
    fn faster_gains_scale_the_roots_in_both_precisions() {
        faster_gains_scale_the_roots::<f64>(1e-14);
        faster_gains_scale_the_roots::<f32>(1e-6);
    }

    #[test]
    fn mixtures_are_gain_by_gain() {
        let (a, b) = (Gains::<f64>::experiments(), Gains::diagonal([[2.0; 3]; 4]));
        let mixed = a * 0.75 + b * 0.25;
        assert_eq!(mixed.position, SymmetricMatrix3::diagonal(38.0, 38.0, 150.5));
        assert_eq!(a * 0.5 + a * 0.5, a);
        assert_eq!(a.faster(1.0), a);
    }
}

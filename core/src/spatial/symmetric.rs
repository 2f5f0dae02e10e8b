//! Symmetric 3 × 3 matrices, stored as six numbers.

use crate::Real;
use core::ops::{Add, Sub};
use nalgebra::{Matrix3, Vector3};

/// A symmetric matrix. `off_diagonal[i]` is the entry whose row and column are the two indices other
/// than `i`: `(yz, zx, xy)`. With this order every formula is the same for all three axes, its
/// indices taken cyclically.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SymmetricMatrix3<T> {
    /// `(xx, yy, zz)`
    pub diagonal: Vector3<T>,
    /// `(yz, zx, xy)`
    pub off_diagonal: Vector3<T>,
}

impl<T: Real> SymmetricMatrix3<T> {
    /// All zero.
    #[inline]
    pub fn zero() -> Self {
        Self { diagonal: Vector3::zeros(), off_diagonal: Vector3::zeros() }
    }

    /// A multiple of the identity.
    #[inline]
    pub fn scalar(x: T) -> Self {
        Self::diagonal(x, x, x)
    }

    /// A diagonal matrix.
    #[inline]
    pub fn diagonal(x: T, y: T, z: T) -> Self {
        Self { diagonal: Vector3::new(x, y, z), off_diagonal: Vector3::zeros() }
    }

    /// The symmetric part of a matrix.
    #[inline]
    pub fn from_matrix(m: &Matrix3<T>) -> Self {
        let half = T::of(0.5);
        Self {
            diagonal: m.diagonal(),
            off_diagonal: Vector3::new(
                (m.m23 + m.m32) * half,
                (m.m31 + m.m13) * half,
                (m.m12 + m.m21) * half,
            ),
        }
    }

    /// All nine numbers.
    #[inline]
    pub fn to_matrix(&self) -> Matrix3<T> {
        let (d, o) = (self.diagonal, self.off_diagonal);
        Matrix3::new(d.x, o.z, o.y, o.z, d.y, o.x, o.y, o.x, d.z)
    }

    /// Column `i` (which is row `i`).
    #[inline(always)]
    pub(crate) fn column<const I: usize>(&self) -> Vector3<T> {
        let (j, k) = ((I + 1) % 3, (I + 2) % 3);
        let mut column = self.diagonal;
        column[j] = self.off_diagonal[k];
        column[k] = self.off_diagonal[j];
        column
    }

    /// `S v`.
    #[inline(always)]
    pub fn product(&self, v: Vector3<T>) -> Vector3<T> {
        let (d, o) = (self.diagonal, self.off_diagonal);
        Vector3::new(
            d.x * v.x + o.z * v.y + o.y * v.z,
            o.z * v.x + d.y * v.y + o.x * v.z,
            o.y * v.x + o.x * v.y + d.z * v.z,
        )
    }

    /// `R S Rᵀ`, for a general rotation.
    #[inline]
    pub fn congruence(&self, r: &Matrix3<T>) -> Self {
        let product = r * self.to_matrix();
        let row = |i: usize| product.fixed_view::<1, 3>(i, 0).transpose();
        let column = |i: usize| r.fixed_view::<1, 3>(i, 0).transpose();
        Self {
            diagonal: Vector3::new(
                row(0).dot(&column(0)),
                row(1).dot(&column(1)),
                row(2).dot(&column(2)),
            ),
            off_diagonal: Vector3::new(
                row(1).dot(&column(2)),
                row(2).dot(&column(0)),
                row(0).dot(&column(1)),
            ),
        }
    }

    /// `v vᵀ`.
    #[inline]
    pub fn outer(v: Vector3<T>) -> Self {
        Self {
            diagonal: v.component_mul(&v),
            off_diagonal: Vector3::new(v.y * v.z, v.z * v.x, v.x * v.y),
        }
    }

    /// `S − x v vᵀ`.
    #[inline(always)]
    pub(crate) fn minus_outer(&self, v: Vector3<T>, x: T) -> Self {
        let w = v * x;
        Self {
            diagonal: self.diagonal - v.component_mul(&w),
            off_diagonal: self.off_diagonal - Vector3::new(v.y * w.z, v.z * w.x, v.x * w.y),
        }
    }

    /// The factor times every entry.
    #[inline]
    pub fn scaled(&self, factor: T) -> Self {
        Self { diagonal: self.diagonal * factor, off_diagonal: self.off_diagonal * factor }
    }

    /// The inverse of a positive definite matrix by its adjugate, or `None` where the determinant is
    /// not positive (also for NaN).
    #[inline]
    pub fn inverse(&self) -> Option<Self> {
        let (d, o) = (self.diagonal, self.off_diagonal);
        let cofactor = Self {
            diagonal: Vector3::new(
                d.y * d.z - o.x * o.x,
                d.z * d.x - o.y * o.y,
                d.x * d.y - o.z * o.z,
            ),
            off_diagonal: Vector3::new(
                o.y * o.z - d.x * o.x,
                o.z * o.x - d.y * o.y,
                o.x * o.y - d.z * o.z,
            ),
        };
        let determinant = d.x * cofactor.diagonal.x
            + o.z * cofactor.off_diagonal.z
            + o.y * cofactor.off_diagonal.y;
        if determinant > T::zero() { Some(cofactor.scaled(T::one() / determinant)) } else { None }
    }
}

impl<T: Real> Add for SymmetricMatrix3<T> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self {
            diagonal: self.diagonal + other.diagonal,
            off_diagonal: self.off_diagonal + other.off_diagonal,
        }
    }
}

impl<T: Real> Sub for SymmetricMatrix3<T> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self {
            diagonal: self.diagonal - other.diagonal,
            off_diagonal: self.off_diagonal - other.off_diagonal,
        }
    }
}

//! Relative rotations as joints make them: about a coordinate axis, general, or none.
//!
//! A turn about a coordinate axis mixes two components and leaves one alone: 4 multiplications for a
//! vector instead of 9, 20 operations for a symmetric matrix instead of 75.

use super::SymmetricMatrix3;
use crate::Real;
use nalgebra::{Matrix3, Vector3};

/// Cosine and sine of a turn about a coordinate axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisTurn<T> {
    /// `cos θ`
    pub cosine: T,
    /// `sin θ`
    pub sine: T,
}

/// The rotation of an outboard frame relative to its inboard frame. All methods named `inboard`
/// take coordinates in the outboard frame to the inboard one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rotation<T> {
    /// The axes are parallel.
    Identity,
    /// A turn about x.
    X(AxisTurn<T>),
    /// A turn about y.
    Y(AxisTurn<T>),
    /// A turn about z.
    Z(AxisTurn<T>),
    /// Any other rotation.
    General(Matrix3<T>),
}

impl<T: Real> Rotation<T> {
    /// `R v`: outboard coordinates to inboard ones.
    #[inline(always)]
    pub fn inboard(&self, v: Vector3<T>) -> Vector3<T> {
        match self {
            Self::Identity => v,
            Self::X(turn) => turn.vector::<0>(v),
            Self::Y(turn) => turn.vector::<1>(v),
            Self::Z(turn) => turn.vector::<2>(v),
            Self::General(r) => r * v,
        }
    }

    /// `Rᵀ v`: inboard coordinates to outboard ones.
    #[inline(always)]
    pub fn outboard(&self, v: Vector3<T>) -> Vector3<T> {
        match self {
            Self::Identity => v,
            Self::X(turn) => turn.back().vector::<0>(v),
            Self::Y(turn) => turn.back().vector::<1>(v),
            Self::Z(turn) => turn.back().vector::<2>(v),
            Self::General(r) => r.tr_mul(&v),
        }
    }

    /// `R S Rᵀ`.
    #[inline(always)]
    pub fn inboard_symmetric(&self, s: &SymmetricMatrix3<T>) -> SymmetricMatrix3<T> {
        match self {
            Self::Identity => *s,
            Self::X(turn) => turn.symmetric::<0>(s),
            Self::Y(turn) => turn.symmetric::<1>(s),
            Self::Z(turn) => turn.symmetric::<2>(s),
            Self::General(r) => s.congruence(r),
        }
    }

    /// `M R`: the columns of `M` combined as the outboard axes.
    #[inline(always)]
    pub fn compose(&self, m: &Matrix3<T>) -> Matrix3<T> {
        match self {
            Self::Identity => *m,
            Self::X(turn) => turn.columns::<0>(m),
            Self::Y(turn) => turn.columns::<1>(m),
            Self::Z(turn) => turn.columns::<2>(m),
            Self::General(r) => m * r,
        }
    }

    /// All nine numbers.
    #[inline]
    pub fn to_matrix(&self) -> Matrix3<T> {
        self.compose(&Matrix3::identity())
    }
}

impl<T: Real> AxisTurn<T> {
    /// Of an angle in radians.
    #[inline]
    pub fn new(angle: T) -> Self {
        let (sine, cosine) = angle.sine_cosine();
        Self { cosine, sine }
    }

    /// The opposite turn.
    #[inline(always)]
    pub(crate) fn back(&self) -> Self {
        Self { cosine: self.cosine, sine: -self.sine }
    }

    /// `R v`.
    #[inline(always)]
    pub(crate) fn vector<const I: usize>(&self, v: Vector3<T>) -> Vector3<T> {
        let (j, k) = ((I + 1) % 3, (I + 2) % 3);
        let (c, s) = (self.cosine, self.sine);
        let mut w = v;
        w[j] = c * v[j] - s * v[k];
        w[k] = s * v[j] + c * v[k];
        w
    }

    /// `R S Rᵀ`. The 2 × 2 block across the axis turns by twice the angle about its mean:
    /// with `d = S_jj − S_kk`, `S_jj' = S_jj − s (s d + 2c S_jk)` and
    /// `S_jk' = S_jk + s (c d − 2s S_jk)`.
    #[inline(always)]
    pub(crate) fn symmetric<const I: usize>(&self, m: &SymmetricMatrix3<T>) -> SymmetricMatrix3<T> {
        let (j, k) = ((I + 1) % 3, (I + 2) % 3);
        let (c, s) = (self.cosine, self.sine);
        let (d, o) = (m.diagonal, m.off_diagonal);
        let twice = o[I] + o[I];
        let difference = d[j] - d[k];
        let change = s * (s * difference + c * twice);
        let mut turned = *m;
        turned.diagonal[j] = d[j] - change;
        turned.diagonal[k] = d[k] + change;
        turned.off_diagonal[I] = o[I] + s * (c * difference - s * twice);
        // Row I: entry (I, j) is off_diagonal[k], entry (I, k) is off_diagonal[j].
        turned.off_diagonal[k] = c * o[k] - s * o[j];
        turned.off_diagonal[j] = s * o[k] + c * o[j];
        turned
    }

    /// `M R`: the new columns j, k are combinations of the old ones.
    #[inline(always)]
    pub(crate) fn columns<const I: usize>(&self, m: &Matrix3<T>) -> Matrix3<T> {
        let (j, k) = ((I + 1) % 3, (I + 2) % 3);
        let (c, s) = (self.cosine, self.sine);
        let mut turned = *m;
        for row in 0..3 {
            turned[(row, j)] = c * m[(row, j)] + s * m[(row, k)];
            turned[(row, k)] = c * m[(row, k)] - s * m[(row, j)];
        }
        turned
    }

    /// `R M Rᵀ` for a matrix without symmetry.
    #[inline(always)]
    pub(crate) fn similarity<const I: usize>(&self, m: &Matrix3<T>) -> Matrix3<T> {
        // M Rᵀ is a composition with the opposite turn; R M turns each column as a vector.
        let right = self.back().columns::<I>(m);
        let (j, k) = ((I + 1) % 3, (I + 2) % 3);
        let (c, s) = (self.cosine, self.sine);
        let mut turned = right;
        for column in 0..3 {
            turned[(j, column)] = c * right[(j, column)] - s * right[(k, column)];
            turned[(k, column)] = s * right[(j, column)] + c * right[(k, column)];
        }
        turned
    }
}

//! Articulated-body inertias (§3.4.1): symmetric 6 × 6 matrices as 21 numbers.

use super::{RigidInertia, Rotation, SymmetricMatrix3, Twist, Wrench};
use crate::Real;
use nalgebra::{Matrix3, Vector3};

/// `P` of (3.36), with `F = P V̇ + z`, in blocks by linear and angular parts:
/// `f = P_vv v + P_vω ω`, `τ = P_vωᵀ v + P_ωω ω`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArticulatedInertia<T> {
    /// `P_vv` (kg)
    pub linear: SymmetricMatrix3<T>,
    /// `P_vω` (kg·m)
    pub coupling: Matrix3<T>,
    /// `P_ωω` (kg·m²)
    pub angular: SymmetricMatrix3<T>,
}

impl<T: Real> ArticulatedInertia<T> {
    /// All zero.
    #[inline]
    pub fn zero() -> Self {
        Self {
            linear: SymmetricMatrix3::zero(),
            coupling: Matrix3::zeros(),
            angular: SymmetricMatrix3::zero(),
        }
    }

    /// `P V`.
    #[inline(always)]
    pub fn product(&self, twist: Twist<T>) -> Wrench<T> {
        let (v, w) = (twist.linear, twist.angular);
        Wrench {
            force: self.linear.product(v) + self.coupling * w,
            torque: self.coupling.tr_mul(&v) + self.angular.product(w),
        }
    }

    /// The image of a turn at unit rate about axis `I`: column `3 + I`.
    #[inline(always)]
    pub(crate) fn angular_column<const I: usize>(&self) -> Wrench<T> {
        let c = &self.coupling;
        Wrench {
            // `Matrix3::column(I).into_owned()` has a panicking path.
            force: Vector3::new(c[(0, I)], c[(1, I)], c[(2, I)]),
            torque: self.angular.column::<I>(),
        }
    }

    /// The image of unit velocity along axis `I`: column `I`.
    #[inline(always)]
    pub(crate) fn linear_column<const I: usize>(&self) -> Wrench<T> {
        let c = &self.coupling;
        Wrench {
            force: self.linear.column::<I>(),
            torque: Vector3::new(c[(I, 0)], c[(I, 1)], c[(I, 2)]),
        }
    }

    /// `P − x U Uᵀ`.
    #[inline(always)]
    pub(crate) fn minus_outer(&self, u: Wrench<T>, x: T) -> Self {
        let scaled = u.torque * x;
        let (f, t) = (u.force, scaled);
        let c = &self.coupling;
        Self {
            linear: self.linear.minus_outer(f, x),
            coupling: Matrix3::new(
                c.m11 - f.x * t.x,
                c.m12 - f.x * t.y,
                c.m13 - f.x * t.z,
                c.m21 - f.y * t.x,
                c.m22 - f.y * t.y,
                c.m23 - f.y * t.z,
                c.m31 - f.z * t.x,
                c.m32 - f.z * t.y,
                c.m33 - f.z * t.z,
            ),
            angular: self.angular.minus_outer(u.torque, x),
        }
    }

    /// In the axes of the inboard frame, origin unchanged.
    #[inline(always)]
    pub fn rotated_inboard(&self, rotation: &Rotation<T>) -> Self {
        match rotation {
            Rotation::Identity => *self,
            Rotation::X(turn) => self.turned::<0>(turn),
            Rotation::Y(turn) => self.turned::<1>(turn),
            Rotation::Z(turn) => self.turned::<2>(turn),
            Rotation::General(r) => Self {
                linear: self.linear.congruence(r),
                coupling: r * self.coupling * r.transpose(),
                angular: self.angular.congruence(r),
            },
        }
    }

    #[inline(always)]
    fn turned<const I: usize>(&self, turn: &super::AxisTurn<T>) -> Self {
        Self {
            linear: turn.symmetric::<I>(&self.linear),
            coupling: turn.similarity::<I>(&self.coupling),
            angular: turn.symmetric::<I>(&self.angular),
        }
    }

    /// Seen from an origin from which this frame's origin lies at `arm` (m); axes unchanged:
    /// `C' = C − P_vv r̂`, `P_ωω' = P_ωω + r̂ C' + (r̂ C)ᵀ`.
    #[inline(always)]
    pub fn shifted(&self, arm: Vector3<T>) -> Self {
        let r = arm;
        let m = self.linear.to_matrix();
        let c = &self.coupling;
        // Column j of M r̂ is M (r̂ e_j); r̂ e_x = (0, r_z, −r_y), and so on.
        let shifted = Matrix3::from_columns(&[
            c.column(0) - (m.column(1) * r.z - m.column(2) * r.y),
            c.column(1) - (m.column(2) * r.x - m.column(0) * r.z),
            c.column(2) - (m.column(0) * r.y - m.column(1) * r.x),
        ]);
        // r̂ C' + (r̂ C)ᵀ is symmetric; only its upper half is formed.
        let (n, o) = (&shifted, c);
        Self {
            linear: self.linear,
            coupling: shifted,
            angular: self.angular
                + SymmetricMatrix3 {
                    diagonal: Vector3::new(
                        r.y * (n.m31 + o.m31) - r.z * (n.m21 + o.m21),
                        r.z * (n.m12 + o.m12) - r.x * (n.m32 + o.m32),
                        r.x * (n.m23 + o.m23) - r.y * (n.m13 + o.m13),
                    ),
                    off_diagonal: Vector3::new(
                        // (y, z): row y of r̂ C', column z; plus (r̂ C)(z, y)
                        r.z * n.m13 - r.x * n.m33 + r.x * o.m22 - r.y * o.m12,
                        // (z, x)
                        r.x * n.m21 - r.y * n.m11 + r.y * o.m33 - r.z * o.m23,
                        // (x, y)
                        r.y * n.m32 - r.z * n.m22 + r.z * o.m11 - r.x * o.m31,
                    ),
                },
        }
    }

    /// The 6 × 6 array, linear part first.
    pub fn to_array(&self) -> [[T; 6]; 6] {
        let mut full = [[T::zero(); 6]; 6];
        let (linear, angular) = (self.linear.to_matrix(), self.angular.to_matrix());
        for i in 0..3 {
            for j in 0..3 {
                full[i][j] = linear[(i, j)];
                full[i][j + 3] = self.coupling[(i, j)];
                full[j + 3][i] = self.coupling[(i, j)];
                full[i + 3][j + 3] = angular[(i, j)];
            }
        }
        full
    }
}

impl<T: Real> From<RigidInertia<T>> for ArticulatedInertia<T> {
    #[inline]
    fn from(body: RigidInertia<T>) -> Self {
        let h = body.first_moment;
        Self {
            linear: SymmetricMatrix3::scalar(body.mass),
            // f = m v + ω × h = m v − ĥ ω
            coupling: -h.cross_matrix(),
            angular: body.rotational,
        }
    }
}

impl<T: Real> core::ops::Add for ArticulatedInertia<T> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self {
            linear: self.linear + other.linear,
            coupling: self.coupling + other.coupling,
            angular: self.angular + other.angular,
        }
    }
}

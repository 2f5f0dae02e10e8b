//! The inertia of one rigid body about a frame's origin: ten numbers.

use super::{SymmetricMatrix3, Twist, Wrench};
use crate::Real;
use nalgebra::Vector3;

/// Mass (kg), first moment of mass `h = m c` (kg·m) and rotational inertia `J` about the frame's
/// origin (kg·m²).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidInertia<T> {
    /// `m`
    pub mass: T,
    /// `h = m c`, with `c` the centre of mass
    pub first_moment: Vector3<T>,
    /// `J`, about the origin
    pub rotational: SymmetricMatrix3<T>,
}

impl<T: Real> RigidInertia<T> {
    /// A body whose inertia about its centre of mass is `central`, seen from an origin that has the
    /// centre of mass at `center` (m): `J = I_c + m(|c|² 1 − c cᵀ)`.
    #[inline]
    pub fn about(mass: T, center: Vector3<T>, central: SymmetricMatrix3<T>) -> Self {
        Self {
            mass,
            first_moment: center * mass,
            rotational: central + SymmetricMatrix3::scalar(center.norm_squared() * mass)
                - SymmetricMatrix3::outer(center).scaled(mass),
        }
    }

    /// Momentum of a velocity, or wrench of an acceleration:
    /// `f = m v + ω × h`, `τ = h × v + J ω`.
    #[inline]
    pub fn product(&self, twist: Twist<T>) -> Wrench<T> {
        let (v, w, h) = (twist.linear, twist.angular, self.first_moment);
        Wrench {
            force: v * self.mass + w.cross(&h),
            torque: h.cross(&v) + self.rotational.product(w),
        }
    }

    /// The same body seen from an origin from which this frame's origin lies at `arm` (m); axes
    /// unchanged: `h' = h + m r`, `J' = J + (2 h·r + m r·r) 1 − (h rᵀ + r hᵀ) − m r rᵀ`.
    #[inline]
    pub fn shifted(&self, arm: Vector3<T>) -> Self {
        let (h, r) = (self.first_moment, arm);
        let g = h + h + r * self.mass;
        // (2h + mr)·r 1 − sym((2h + mr) rᵀ)
        let half = T::of(0.5);
        let trace = g.dot(&r);
        let product = SymmetricMatrix3 {
            diagonal: g.component_mul(&r),
            off_diagonal: Vector3::new(
                (g.y * r.z + g.z * r.y) * half,
                (g.z * r.x + g.x * r.z) * half,
                (g.x * r.y + g.y * r.x) * half,
            ),
        };
        Self {
            mass: self.mass,
            first_moment: h + r * self.mass,
            rotational: self.rotational + SymmetricMatrix3::scalar(trace) - product,
        }
    }
}

impl<T: Real> core::ops::Add for RigidInertia<T> {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self {
            mass: self.mass + other.mass,
            first_moment: self.first_moment + other.first_moment,
            rotational: self.rotational + other.rotational,
        }
    }
}

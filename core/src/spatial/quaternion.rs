//! Quaternions, scalar first (Appendix A.3).

use crate::Real;
use nalgebra::{Matrix3, Vector3};

/// A quaternion `(s, v)`. Of unit norm where it stands for an orientation.
///
/// ```
/// use surefoot::spatial::Quaternion;
/// let quarter_turn = Quaternion::<f64>::from_array([0.5_f64.sqrt(), 0.0, 0.0, 0.5_f64.sqrt()]);
/// let x = nalgebra::Vector3::new(1.0, 0.0, 0.0);
/// assert!((quarter_turn.rotate(x) - nalgebra::Vector3::new(0.0, 1.0, 0.0)).norm() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quaternion<T> {
    /// Scalar part.
    pub s: T,
    /// Vector part.
    pub v: Vector3<T>,
}

impl<T: Real> Quaternion<T> {
    /// The orientation that changes nothing.
    #[inline]
    pub fn identity() -> Self {
        Self { s: T::one(), v: Vector3::zeros() }
    }

    /// From `[s, x, y, z]`.
    #[inline]
    pub fn from_array([s, x, y, z]: [T; 4]) -> Self {
        Self { s, v: Vector3::new(x, y, z) }
    }

    /// As `[s, x, y, z]`.
    #[inline]
    pub fn to_array(self) -> [T; 4] {
        [self.s, self.v.x, self.v.y, self.v.z]
    }

    /// Rotation by `angle` (radians) about the unit vector `axis`.
    #[inline]
    pub fn from_axis_angle(axis: Vector3<T>, angle: T) -> Self {
        let (sine, cosine) = (angle * T::of(0.5)).sine_cosine();
        Self { s: cosine, v: axis * sine }
    }

    /// The exponential of a rotation vector (radians): the orientation reached from the identity by
    /// turning at that constant angular velocity for one second. Exact for every angle, zero included.
    #[inline]
    pub fn from_rotation_vector(rotation: Vector3<T>) -> Self {
        let angle = rotation.norm();
        // Below this the series sin(x/2)/x = 1/2 − x²/48 is exact to round-off in f64 and f32.
        if angle < T::of(1e-4) {
            let squared = angle * angle;
            let s = T::one() - squared * T::of(0.125);
            return Self { s, v: rotation * (T::of(0.5) - squared / T::of(48.0)) };
        }
        Self::from_axis_angle(rotation / angle, angle)
    }

    /// `a ⋆ b`: first rotate by `b`, then by `a`.
    #[inline]
    pub fn product(self, b: Self) -> Self {
        Self {
            s: self.s * b.s - self.v.dot(&b.v),
            v: b.v * self.s + self.v * b.s + self.v.cross(&b.v),
        }
    }

    /// `(s, −v)`, for a unit quaternion its inverse.
    #[inline]
    pub fn conjugate(self) -> Self {
        Self { s: self.s, v: -self.v }
    }

    /// `s² + |v|²`.
    #[inline]
    pub fn norm_squared(self) -> T {
        self.s * self.s + self.v.norm_squared()
    }

    /// Scaled to unit norm; `None` where the norm is zero or not finite.
    #[inline]
    pub fn normalized(self) -> Option<Self> {
        let squared = self.norm_squared();
        if squared > T::zero() && squared.is_finite() {
            let scale = T::one() / squared.sqrt();
            Some(Self { s: self.s * scale, v: self.v * scale })
        } else {
            None
        }
    }

    /// The vector `w` after the rotation: the vector part of `q ⋆ (0, w) ⋆ q̄`.
    #[inline]
    pub fn rotate(self, w: Vector3<T>) -> Vector3<T> {
        let t = self.v.cross(&w) * T::of(2.0);
        w + t * self.s + self.v.cross(&t)
    }

    /// The same orientation as a matrix: `(2s² − 1)I + 2s v̂ + 2vvᵀ`, in the form that is orthogonal
    /// to first order in an error of the norm. 24 operations.
    #[inline]
    pub fn to_matrix(self) -> Matrix3<T> {
        let two = T::of(2.0);
        let one = T::one();
        let (s, x, y, z) = (self.s, self.v.x, self.v.y, self.v.z);
        let (xx, yy, zz) = (two * x * x, two * y * y, two * z * z);
        let (xy, xz, yz) = (two * x * y, two * x * z, two * y * z);
        let (sx, sy, sz) = (two * s * x, two * s * y, two * s * z);
        Matrix3::new(
            one - yy - zz,
            xy - sz,
            xz + sy,
            xy + sz,
            one - xx - zz,
            yz - sx,
            xz - sy,
            yz + sx,
            one - xx - yy,
        )
    }

    /// The orientation of a rotation matrix, its largest component positive: from that of the four which is
    /// largest, so that nothing is divided by a small number (Shepperd, J. Guidance and Control 1(3), 1978). Of a
    /// matrix that is none, whatever comes out.
    #[inline]
    pub fn from_matrix(m: &Matrix3<T>) -> Self {
        let (one, half) = (T::one(), T::of(0.5));
        let trace = m.m11 + m.m22 + m.m33;
        let most = m.m11.max(m.m22).max(m.m33);
        let of = |square: T| {
            let root = square.sqrt();
            (root * half, half / root)
        };
        if trace >= most {
            let (s, scale) = of(one + trace);
            let v = Vector3::new(m.m32 - m.m23, m.m13 - m.m31, m.m21 - m.m12) * scale;
            return Self { s, v };
        }
        if m.m11 >= most {
            let (x, scale) = of(one + m.m11 - m.m22 - m.m33);
            let v = Vector3::new(x, (m.m12 + m.m21) * scale, (m.m13 + m.m31) * scale);
            return Self { s: (m.m32 - m.m23) * scale, v };
        }
        if m.m22 >= most {
            let (y, scale) = of(one + m.m22 - m.m11 - m.m33);
            let v = Vector3::new((m.m12 + m.m21) * scale, y, (m.m23 + m.m32) * scale);
            return Self { s: (m.m13 - m.m31) * scale, v };
        }
        let (z, scale) = of(one + m.m33 - m.m11 - m.m22);
        let v = Vector3::new((m.m13 + m.m31) * scale, (m.m23 + m.m32) * scale, z);
        Self { s: (m.m21 - m.m12) * scale, v }
    }

    /// `dq/dt` for the body angular velocity `ω` (rad/s): `½ q ⋆ (0, ω)`, the product `B(q)ω` of (A.4).
    #[inline]
    pub fn rate(self, body_angular_velocity: Vector3<T>) -> Self {
        self.product(Self { s: T::zero(), v: body_angular_velocity * T::of(0.5) })
    }
}

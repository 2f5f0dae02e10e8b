//! A foot in contact: where it is, what its leg and the ground can do for it.

use crate::Real;
use crate::spatial::{Twist, Wrench};
use nalgebra::{Matrix3, Vector3};

/// Where a foot touches the ground: a rectangle in sole axes (x along the sole, z normal to it, out of
/// the ground), which may have no width (an edge) or neither width nor length (a point).
///
/// An edge has no moment about itself, and a point none at all: these are then no unknowns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactPatch<T> {
    /// Centre, from the foot's reference point, m. Zero for an edge and a point.
    pub(in crate::balance) center: Vector3<T>,
    /// Half the length along x, m.
    pub(in crate::balance) half_x: T,
    /// Half the length along y, m.
    pub(in crate::balance) half_y: T,
}

impl ContactPatch<f32> {
    /// With half its lengths along x and y, the reference point in its middle: an edge where one of them is
    /// zero, a point where both are.
    pub const fn centered([half_x, half_y]: [f32; 2]) -> Self {
        Self { center: Vector3::new(0.0, 0.0, 0.0), half_x, half_y }
    }

    /// What [`centered`](Self::centered) makes it of.
    pub const fn half_lengths(&self) -> [f32; 2] {
        [self.half_x, self.half_y]
    }
}

impl<T: Real> ContactPatch<T> {
    /// A rectangle from its least and greatest x and y and its height z, from the reference point (m).
    pub fn sole([x0, x1]: [T; 2], [y0, y1]: [T; 2], z: T) -> Self {
        let half = T::of(0.5);
        Self {
            center: Vector3::new((x0 + x1) * half, (y0 + y1) * half, z),
            half_x: (x1 - x0) * half,
            half_y: (y1 - y0) * half,
        }
    }

    /// A line of this length (m) along the sole's x, the reference point in its middle.
    pub fn edge_along_x(length: T) -> Self {
        Self { half_x: length * T::of(0.5), ..Self::point() }
    }

    /// A line of this length (m) along the sole's y, the reference point in its middle.
    pub fn edge_along_y(length: T) -> Self {
        Self { half_y: length * T::of(0.5), ..Self::point() }
    }

    /// The reference point.
    pub fn point() -> Self {
        Self { center: Vector3::zeros(), half_x: T::zero(), half_y: T::zero() }
    }

    /// The same with its lengths times `share`, about its centre.
    pub fn shrunk(&self, share: T) -> Self {
        Self { half_x: self.half_x * share, half_y: self.half_y * share, ..*self }
    }

    /// The same in another precision.
    pub fn rounded<U: Real>(&self) -> ContactPatch<U> {
        let round = |x: T| U::of(x.to_f64());
        ContactPatch {
            center: self.center.map(round),
            half_x: round(self.half_x),
            half_y: round(self.half_y),
        }
    }

    /// Whether it has width and length.
    #[inline(always)]
    pub(super) fn is_sole(&self) -> bool {
        self.half_x > T::zero() && self.half_y > T::zero()
    }

    /// Whether moments about the sole's x, y, z are unknowns.
    #[inline(always)]
    pub fn moments(&self) -> [bool; 3] {
        let (x, y) = (self.half_x > T::zero(), self.half_y > T::zero());
        [y, x, x || y]
    }
}

/// What a foot's ground and its leg's motors can give.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactLimits<T, const JOINTS: usize> {
    /// Least force normal to the sole, N, not negative.
    pub least_force: T,
    /// Greatest force normal to the sole, N.
    pub greatest_force: T,
    /// Coulomb friction coefficient. The cone is taken as the pyramid inside it.
    pub friction: T,
    /// Where the foot touches the ground.
    pub patch: ContactPatch<T>,
    /// Greatest torque (N·m) or force (N) of each joint, hip to foot, in either sense.
    pub torques: [T; JOINTS],
}

impl<const JOINTS: usize> ContactLimits<f32, JOINTS> {
    /// The same numbers in double precision.
    pub fn to_f64(&self) -> ContactLimits<f64, JOINTS> {
        ContactLimits {
            least_force: self.least_force.into(),
            greatest_force: self.greatest_force.into(),
            friction: self.friction.into(),
            patch: ContactPatch {
                center: self.patch.center.map(f64::from),
                half_x: self.patch.half_x.into(),
                half_y: self.patch.half_y.into(),
            },
            torques: self.torques.map(f64::from),
        }
    }
}

impl<const JOINTS: usize> ContactLimits<f64, JOINTS> {
    /// The same in single precision.
    pub const fn to_f32(&self) -> ContactLimits<f32, JOINTS> {
        let [x, y, z] = self.patch.center.data.0[0];
        let mut torques = [0.0; JOINTS];
        let mut k = 0;
        while k < JOINTS {
            torques[k] = self.torques[k] as f32;
            k += 1;
        }
        ContactLimits {
            least_force: self.least_force as f32,
            greatest_force: self.greatest_force as f32,
            friction: self.friction as f32,
            patch: ContactPatch {
                center: Vector3::new(x as f32, y as f32, z as f32),
                half_x: self.patch.half_x as f32,
                half_y: self.patch.half_y as f32,
            },
            torques,
        }
    }
}

/// One foot in contact, with its leg of `JOINTS` joints (at most 7).
///
/// Sole axes and reference point are the caller's choice; the printed split has the foot's centre of
/// mass. For an edge or a point the reference point is on it.
#[derive(Clone, Copy, Debug)]
pub struct ContactFoot<'a, T, const JOINTS: usize> {
    /// `R`: frame 1 from sole axes.
    pub rotation: Matrix3<T>,
    /// `p`: reference point, in frame 1, m.
    pub position: Vector3<T>,
    /// Twist of the reference point per rate of each joint, frame 1's axes: `(e × (p − q), e)` for a
    /// revolute joint at q about e, `(e, 0)` for a prismatic one.
    pub joints: [Twist<T>; JOINTS],
    /// `c`: what the ground gives beside `w`, in sole axes about the reference point.
    pub carried: Wrench<T>,
    /// Its limits.
    pub limits: &'a ContactLimits<T, JOINTS>,
}

impl<T: Real, const JOINTS: usize> ContactFoot<'_, T, JOINTS> {
    /// Torques of the joints that make the wrench `w` (frame 1's axes): `τ_k = −(J_k · w)`.
    #[inline(always)]
    pub fn torques(&self, w: &Wrench<T>) -> [T; JOINTS] {
        self.joints.map(|twist| -twist.power(*w))
    }

    /// The same, each within its limit: what to do while an answer is not the program's yet.
    #[inline(always)]
    pub fn clipped_torques(&self, w: &Wrench<T>) -> [T; JOINTS] {
        let mut torques = self.torques(w);
        for (torque, limit) in torques.iter_mut().zip(&self.limits.torques) {
            *torque = torque.max(-*limit).min(*limit);
        }
        torques
    }

    /// A wrench in frame 1's axes, turned into sole axes.
    #[inline(always)]
    pub(super) fn in_sole_axes(&self, wrench: &Wrench<T>) -> Wrench<T> {
        Wrench {
            force: self.rotation.tr_mul(&wrench.force),
            torque: self.rotation.tr_mul(&wrench.torque),
        }
    }

    /// Of a moment in frame 1's axes, the part that is unknown.
    #[inline(always)]
    pub(super) fn free_moment(&self, moment: Vector3<T>) -> Vector3<T> {
        let free = self.limits.patch.moments();
        match free {
            [true, true, true] => moment,
            [false, false, false] => Vector3::zeros(),
            _ => {
                let mut in_sole = self.rotation.tr_mul(&moment);
                for (x, free) in in_sole.iter_mut().zip(free) {
                    if !free {
                        *x = T::zero();
                    }
                }
                self.rotation * in_sole
            }
        }
    }

    /// The moment of `w` that is not free: what it takes for the ground to have none in these
    /// directions. In frame 1's axes.
    #[inline(always)]
    pub(super) fn fixed_moment(&self) -> Vector3<T> {
        let carried = self.rotation * self.carried.torque;
        self.free_moment(carried) - carried
    }
}

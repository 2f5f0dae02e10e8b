//! What the ground can do for a foot: press, hold by friction, within the sole.

use super::robot::LEG;
use super::{CentralBody, FootLimit, LegKinematics};
use crate::Real;
use crate::spatial::Wrench;
use nalgebra::Vector3;

/// A rectangular sole in the frame of the last joint: origin at the ankle, axes as the robot was
/// described at home.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sole<T> {
    /// Least and greatest x, m.
    pub x: [T; 2],
    /// Least and greatest y, m.
    pub y: [T; 2],
    /// Height of the sole over the ankle (negative), m.
    pub z: T,
}

/// Limits of every foot of a robot. The floor is horizontal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FootLimits<T> {
    /// Least normal force, N. Zero forbids pulling and no more.
    pub least_normal_force: T,
    /// Coulomb friction coefficient; `None` for no limit.
    pub friction: Option<T>,
    /// Where the centre of pressure may lie; `None` for anywhere.
    pub sole: Option<Sole<T>>,
}

impl<T: Real> FootLimits<T> {
    /// The first limit that the wrench `foot` (on the foot, at its centre of mass, frame 1's axes)
    /// breaks.
    #[inline(always)]
    pub(super) fn broken(
        &self,
        central: &CentralBody<T>,
        leg: &LegKinematics<T>,
        foot: Wrench<T>,
    ) -> Option<FootLimit> {
        // The floor's normal in frame 1 is the last row of R_01.
        let r = &central.rotation;
        let up = Vector3::new(r.m31, r.m32, r.m33);
        let normal = foot.force.dot(&up);
        if !(normal >= self.least_normal_force) {
            return Some(FootLimit::Pull);
        }
        if let Some(friction) = self.friction {
            let tangential = foot.force - up * normal;
            let limit = friction * normal;
            if tangential.norm_squared() > limit * limit {
                return Some(FootLimit::Friction);
            }
        }
        if let Some(sole) = &self.sole {
            let ankle = leg.origins[LEG - 1];
            let axes = &leg.rotations[LEG - 1];
            let f = axes.tr_mul(&foot.force);
            let n = axes.tr_mul(&foot.shifted(leg.foot.position - ankle).torque);
            // The point (x, y, z) of the sole about which the moment has no x and y part:
            // n − r × f = (0, 0, ·), times the force normal to the sole.
            let x = sole.z * f.x - n.y;
            let y = sole.z * f.y + n.x;
            let inside = |value: T, [least, greatest]: [T; 2]| {
                value >= least * f.z && value <= greatest * f.z
            };
            if !(inside(x, sole.x) && inside(y, sole.y)) {
                return Some(FootLimit::CenterOfPressure);
            }
        }
        None
    }
}

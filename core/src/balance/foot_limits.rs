//! What the ground can do for a foot: press, hold by friction, within the sole.

use super::ground_wrench::{FixedFootWrenches, in_axes, sole_axes};
use super::robot::LEG;
use super::{Fault, FootLimit, FootWrenches, LegKinematics, LeggedRobot};
use crate::Real;
use crate::spatial::Wrench;
use nalgebra::Vector3;

/// A rectangular sole: origin at the last joint, axes as the robot was described at home, fixed to the
/// foot.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sole<T> {
    /// Least and greatest x, m.
    pub x: [T; 2],
    /// Least and greatest y, m.
    pub y: [T; 2],
    /// Height of the sole over the last joint (negative), m.
    pub z: T,
}

/// Limits of every foot of a robot, on the wrench that the ground gives it. The foot lies flat on its
/// floor: the normal is the z axis of the sole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FootLimits<T> {
    least_normal_force: T,
    friction: Option<T>,
    sole: Option<Sole<T>>,
}

/// What can be wrong with foot limits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FootLimitsFault {
    /// The least normal force is negative, NaN or infinite.
    LeastNormalForce,
    /// The friction coefficient is negative, NaN or infinite.
    Friction,
    /// The sole's range along x is inverted, or an end of it not finite.
    SoleX,
    /// The sole's range along y, likewise.
    SoleY,
    /// The sole's height is not finite.
    SoleZ,
}

impl<T: Real> FootLimits<T> {
    /// Limits of
    /// - the normal force: at least `least_normal_force` (N); zero forbids pulling and no more,
    /// - the tangential force: at most `friction` times the normal one (Coulomb); `None` for no limit,
    /// - the centre of pressure: within `sole`; `None` for anywhere.
    ///
    /// # Errors
    /// A [`FootLimitsFault`] for what is negative, inverted or not finite. A range of zero length is
    /// an edge or a point, and allowed.
    ///
    /// ```
    /// use surefoot::balance::{FootLimits, FootLimitsFault};
    /// let fault = FootLimits::new(0.0, Some(f64::NAN), None).expect_err("no number");
    /// assert_eq!(fault, FootLimitsFault::Friction);
    /// ```
    pub fn new(
        least_normal_force: T,
        friction: Option<T>,
        sole: Option<Sole<T>>,
    ) -> Result<Self, FootLimitsFault> {
        let is_magnitude = |x: T| x >= T::zero() && x.is_finite();
        let is_range = |[least, greatest]: [T; 2]| {
            least <= greatest && least.is_finite() && greatest.is_finite()
        };
        if !is_magnitude(least_normal_force) {
            return Err(FootLimitsFault::LeastNormalForce);
        }
        if !friction.is_none_or(is_magnitude) {
            return Err(FootLimitsFault::Friction);
        }
        if let Some(sole) = sole {
            if !is_range(sole.x) {
                return Err(FootLimitsFault::SoleX);
            }
            if !is_range(sole.y) {
                return Err(FootLimitsFault::SoleY);
            }
            if !sole.z.is_finite() {
                return Err(FootLimitsFault::SoleZ);
            }
        }
        Ok(Self { least_normal_force, friction, sole })
    }

    /// # Errors
    /// [`Fault::FootWrench`] with the first foot and limit that the ground's wrench breaks while the
    /// joints make the wrenches `feet`.
    #[inline]
    pub(super) fn check<const LEGS: usize>(
        &self,
        robot: &LeggedRobot<T, LEGS>,
        legs: &[LegKinematics<T>; LEGS],
        feet: &FootWrenches<T, LEGS>,
        held: &FixedFootWrenches<T, LEGS>,
    ) -> Result<(), Fault> {
        let axes = sole_axes(robot, legs);
        let wrenches = feet.in_central_axes.iter().zip(&held.ground_bias);
        for (number, ((axes, leg), (foot, bias))) in axes.iter().zip(legs).zip(wrenches).enumerate()
        {
            let ground = in_axes(axes, foot) + *bias;
            let ankle = axes.tr_mul(&(leg.origins[LEG - 1] - leg.foot.position));
            if let Some(limit) = self.broken(ground, ankle) {
                return Err(Fault::FootWrench { leg: number, limit });
            }
        }
        Ok(())
    }

    /// The first limit that the ground's wrench breaks. Both arguments are in sole axes, from the
    /// foot's centre of mass. A number that is NaN breaks every limit.
    #[inline]
    fn broken(&self, ground: Wrench<T>, ankle: Vector3<T>) -> Option<FootLimit> {
        let f = ground.force;
        if !(f.z >= self.least_normal_force) {
            return Some(FootLimit::Pull);
        }
        if let Some(friction) = self.friction {
            let limit = friction * f.z;
            if !(f.x * f.x + f.y * f.y <= limit * limit) {
                return Some(FootLimit::Friction);
            }
        }
        if let Some(sole) = &self.sole {
            let n = ground.shifted(-ankle).torque;
            // The point (x, y, z) of the sole about which the moment has no x and y part:
            // n − r × f = (0, 0, ·), times the normal force.
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

impl core::fmt::Display for FootLimitsFault {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::LeastNormalForce => "the least normal force is negative or not finite",
            Self::Friction => "the friction coefficient is negative or not finite",
            Self::SoleX => "the sole's range along x is inverted or not finite",
            Self::SoleY => "the sole's range along y is inverted or not finite",
            Self::SoleZ => "the sole's height is not finite",
        })
    }
}

impl core::error::Error for FootLimitsFault {}

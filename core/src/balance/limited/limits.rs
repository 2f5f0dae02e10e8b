//! What ground and motors can give a robot, and how a wish beyond it is given up.

use crate::Real;
use crate::balance::robot::LEG;
use crate::balance::{ContactLimits, ContactPatch, ContactWeights, LeggedRobot, Sole};
use crate::qp::{Settings, Work};
use nalgebra::Vector3;

/// What a floor gives every foot.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Ground<T> {
    /// Least force normal to a sole, N, not negative: what keeps a foot that is to stand from lifting.
    pub least_force: T,
    /// Greatest force normal to a sole, N.
    pub greatest_force: T,
    /// Coulomb friction coefficient.
    pub friction: T,
}

/// Limits of the wrenches that a tick may ask for: of the ground on every foot, and of every motor.
#[derive(Clone, Copy, Debug)]
pub struct WrenchLimits<T, const LEGS: usize> {
    /// By leg. The reference point is the foot's centre of mass, axes are the sole's.
    pub legs: [ContactLimits<T, LEG>; LEGS],
    /// What is given up first where not all can be had.
    pub weights: ContactWeights<T>,
    /// How limits give way, and what a tick may spend: of its work no more than [`Self::MOST_WORK`].
    pub settings: Settings<T>,
    /// Where limits bind or a foot is in the air, feet creep. Rate at which they come to rest, and the
    /// joints of a leg whose foot touches nothing, 1/s.
    pub rest_rate: T,
}

/// What can be wrong with limits of wrenches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WrenchLimitsFault {
    /// The least normal force is negative or not finite.
    LeastForce,
    /// The greatest normal force is below the least, or not finite.
    GreatestForce,
    /// The friction coefficient is negative or not finite.
    Friction,
    /// The sole of this leg has no length or width, or an end of it is not finite.
    Sole {
        /// Number of the leg.
        leg: usize,
    },
    /// The greatest torque of this joint is negative or not finite.
    Torque {
        /// Number of the leg.
        leg: usize,
        /// Number of the joint, from the hip.
        joint: usize,
    },
}

impl<T: Real, const LEGS: usize> WrenchLimits<T, LEGS> {
    /// Multiplications that the distribution may spend in one tick: with some nine instructions each on a
    /// Cortex-M4F, 26 000 beside the 14 000 of a tick's other parts.
    pub const MOST_WORK: Work = 2850;

    /// Of rectangular soles on a floor, and of torques (N·m) by leg, hip to foot. Weights of
    /// [`ContactWeights::standing`] with the printed norm (ℓ = 1 m), δ = 1e-3, and what moves coming to
    /// rest at 20/s.
    ///
    /// # Errors
    /// A [`WrenchLimitsFault`] for the first number that can be no limit.
    pub fn new(
        robot: &LeggedRobot<T, LEGS>,
        soles: &[Sole<T>; LEGS],
        ground: Ground<T>,
        torques: &[[T; LEG]; LEGS],
    ) -> Result<Self, WrenchLimitsFault> {
        let is_magnitude = |x: T| x >= T::zero() && x.is_finite();
        if !is_magnitude(ground.least_force) {
            return Err(WrenchLimitsFault::LeastForce);
        }
        if !(is_magnitude(ground.greatest_force) && ground.greatest_force >= ground.least_force) {
            return Err(WrenchLimitsFault::GreatestForce);
        }
        if !is_magnitude(ground.friction) {
            return Err(WrenchLimitsFault::Friction);
        }
        let mut legs = [ContactLimits {
            least_force: ground.least_force,
            greatest_force: ground.greatest_force,
            friction: ground.friction,
            patch: ContactPatch::point(),
            torques: [T::zero(); LEG],
        }; LEGS];
        let given = soles.iter().zip(torques).zip(&robot.legs);
        for (leg, (limits, ((sole, torques), links))) in legs.iter_mut().zip(given).enumerate() {
            let is_range = |[least, greatest]: [T; 2]| {
                least < greatest && least.is_finite() && greatest.is_finite()
            };
            if !(is_range(sole.x) && is_range(sole.y) && sole.z.is_finite()) {
                return Err(WrenchLimitsFault::Sole { leg });
            }
            for (joint, torque) in torques.iter().enumerate() {
                if !is_magnitude(*torque) {
                    return Err(WrenchLimitsFault::Torque { leg, joint });
                }
            }
            // From the last joint, where soles begin, to the foot's centre of mass.
            let foot = &links[LEG - 1];
            let center: Vector3<T> = match &foot.home_axes {
                None => foot.center,
                Some(home) => home * foot.center,
            };
            let moved = |[least, greatest]: [T; 2], by: T| [least - by, greatest - by];
            let (x, y) = (moved(sole.x, center.x), moved(sole.y, center.y));
            limits.patch = ContactPatch::sole(x, y, sole.z - center.z);
            limits.torques = *torques;
        }
        Ok(Self {
            legs,
            weights: ContactWeights { norm_length: T::one(), ..ContactWeights::standing() },
            settings: Settings { work: Self::MOST_WORK, ..Settings::new(T::of(1e-3)) },
            rest_rate: T::of(20.0),
        })
    }
}

impl core::fmt::Display for WrenchLimitsFault {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::LeastForce => f.write_str("the least normal force is negative or not finite"),
            Self::GreatestForce => {
                f.write_str("the greatest normal force is below the least or not finite")
            }
            Self::Friction => f.write_str("the friction coefficient is negative or not finite"),
            Self::Sole { leg } => {
                write!(f, "the sole of leg {leg} has no length, no width, or no finite place")
            }
            Self::Torque { leg, joint } => {
                write!(f, "the torque of joint {joint} of leg {leg} is negative or not finite")
            }
        }
    }
}

impl core::error::Error for WrenchLimitsFault {}

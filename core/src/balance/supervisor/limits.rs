//! What motors, sensors and the robot may do: the limits that a [`Supervisor`](super::Supervisor)
//! keeps. They belong to a robot and stand with its description.

use super::limit_error::{LimitError, LimitFault, LimitField};
use crate::Real;
use crate::balance::robot::LEG;

/// Limits of one joint.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct JointLimits<T> {
    /// Largest torque either way, N·m. Larger ones are cut, and counted.
    pub torque: T,
    /// Least and greatest angle that the encoder can read, rad.
    pub angle: [T; 2],
    /// Largest rate that can be read, rad/s.
    pub rate: T,
}

/// What a joint does in a stop: `τ = −d θ̇`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointDamping<T> {
    /// `d`, N·m·s/rad. Zero leaves the joint limp.
    pub damping: T,
    /// Least inertia that the joint turns, everything else free, kg·m². A torque that is held over a
    /// period `h` brakes only while `d h` is less than this inertia; [`Supervisor::new`](super::Supervisor::new)
    /// takes no larger `d` than half of `I/h`.
    pub inertia: T,
}

/// When measurements are not believed, and when the robot is lost.
///
/// # Residuals
/// A measured angle is compared with where the rates led it over the `h` seconds since the last one,
/// `e = θ − θ' − h (ω + ω')/2` (the trapezoid), and so are the central body's position and orientation
/// with their velocities. A rate that is wrong by `δ` makes a residual of `h δ/2`, one that steps by
/// `δ` within the tick, at most as much. So a residual is *doubtful* beyond `h/2` times the step that a
/// rate may make in a tick, and *gross* beyond [`gross`](Self::gross) times that.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Thresholds<T> {
    /// What an encoder's resolution adds to the residual that is not doubtful, rad.
    pub angle_noise: T,
    /// Step of a joint's rate in a tick that is not doubtful, rad/s.
    pub rate_step: T,
    /// Step of the central body's velocity in a tick that is not doubtful, m/s.
    pub velocity_step: T,
    /// Step of its angular velocity, rad/s.
    pub angular_velocity_step: T,
    /// A residual of this many doubtful ones stops the robot at once; at least 1.
    pub gross: T,
    /// Residual of an encoder that no step of its rate explains, rad: five in a row on one joint say
    /// that angle and rate do not belong together. A foot that chatters as it lands makes three.
    pub frozen_angle: T,
    /// Doubtful ticks in a row that are borne.
    pub doubtful_ticks: u8,
    /// How far a torque may go towards its new value at a doubtful tick, N·m.
    pub torque_step: T,
    /// Ticks in a row without a measurement that are bridged by holding the torques.
    pub bridged_ticks: u8,
    /// Ticks with a measurement that make up for one without.
    pub recovery_ticks: u8,
    /// Smallest cosine of the central body's tilt, [`look_ahead_s`](Self::look_ahead_s) from now.
    pub least_upright: T,
    /// How far the central body may sink below the lower of its reference and of the greatest height
    /// it has had since it was armed, [`look_ahead_s`](Self::look_ahead_s) from now, m.
    pub drop: T,
    /// How far ahead tilt and height are predicted by their rates, s.
    pub look_ahead_s: T,
    /// Downward acceleration of a body that stands on nothing, m/s².
    pub free_fall: T,
    /// How long that may last, s.
    pub free_fall_s: T,
    /// How long some torque may be cut without a pause, s.
    pub saturation_s: T,
}

/// All limits of one robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SafetyLimits<T, const LEGS: usize> {
    /// By leg, hip to foot.
    pub joints: [[JointLimits<T>; LEG]; LEGS],
    /// By leg, hip to foot.
    pub damping: [[JointDamping<T>; LEG]; LEGS],
    /// How long a stop damps, s: the second half of it less and less.
    pub stop_s: T,
    /// Everything that is not of one joint.
    pub thresholds: Thresholds<T>,
}

impl<const LEGS: usize> SafetyLimits<f32, LEGS> {
    /// With rates that are believed `times` as large.
    pub const fn with_rates(mut self, times: f32) -> Self {
        let mut leg = 0;
        while leg < LEGS {
            let mut k = 0;
            while k < LEG {
                self.joints[leg][k].rate *= times;
                k += 1;
            }
            leg += 1;
        }
        self
    }

    /// With steps of the central body's velocity and angular velocity that are believed so many times as large.
    pub const fn with_steps(mut self, velocity: f32, angular_velocity: f32) -> Self {
        self.thresholds.velocity_step *= velocity;
        self.thresholds.angular_velocity_step *= angular_velocity;
        self
    }
}

impl<const LEGS: usize> SafetyLimits<f64, LEGS> {
    /// The same in single precision.
    pub const fn to_f32(&self) -> SafetyLimits<f32, LEGS> {
        let t = &self.thresholds;
        let joint = JointLimits { torque: 0.0, angle: [0.0; 2], rate: 0.0 };
        let damping = JointDamping { damping: 0.0, inertia: 0.0 };
        let mut single = SafetyLimits {
            joints: [[joint; LEG]; LEGS],
            damping: [[damping; LEG]; LEGS],
            stop_s: self.stop_s as f32,
            thresholds: Thresholds {
                angle_noise: t.angle_noise as f32,
                rate_step: t.rate_step as f32,
                velocity_step: t.velocity_step as f32,
                angular_velocity_step: t.angular_velocity_step as f32,
                gross: t.gross as f32,
                frozen_angle: t.frozen_angle as f32,
                doubtful_ticks: t.doubtful_ticks,
                torque_step: t.torque_step as f32,
                bridged_ticks: t.bridged_ticks,
                recovery_ticks: t.recovery_ticks,
                least_upright: t.least_upright as f32,
                drop: t.drop as f32,
                look_ahead_s: t.look_ahead_s as f32,
                free_fall: t.free_fall as f32,
                free_fall_s: t.free_fall_s as f32,
                saturation_s: t.saturation_s as f32,
            },
        };
        let mut leg = 0;
        while leg < LEGS {
            let mut k = 0;
            while k < LEG {
                let of = &self.joints[leg][k];
                single.joints[leg][k] = JointLimits {
                    torque: of.torque as f32,
                    angle: [of.angle[0] as f32, of.angle[1] as f32],
                    rate: of.rate as f32,
                };
                let of = &self.damping[leg][k];
                single.damping[leg][k] =
                    JointDamping { damping: of.damping as f32, inertia: of.inertia as f32 };
                k += 1;
            }
            leg += 1;
        }
        single
    }
}

impl<T: Real, const LEGS: usize> SafetyLimits<T, LEGS> {
    /// Whether every number can be a limit.
    ///
    /// # Errors
    /// The first that cannot, by leg, joint and field.
    pub fn check(&self) -> Result<(), LimitError> {
        for (leg, damping) in self.damping.iter().enumerate() {
            for (joint, stop) in damping.iter().enumerate() {
                for (field, value, is_possible) in [
                    (LimitField::Damping, stop.damping, stop.damping >= T::zero()),
                    (LimitField::Inertia, stop.inertia, stop.inertia > T::zero()),
                ] {
                    possible(value, is_possible)
                        .map_err(|fault| LimitError::of_joint(leg, joint, field, fault))?;
                }
            }
        }
        let stop = possible(self.stop_s, self.stop_s > T::zero());
        stop.map_err(|fault| LimitError::of_robot(LimitField::Stop, fault))?;
        Self::check_both(&self.joints, &self.thresholds)
    }

    fn check_both(
        joints: &[[JointLimits<T>; LEG]; LEGS],
        thresholds: &Thresholds<T>,
    ) -> Result<(), LimitError> {
        for (leg, joints) in joints.iter().enumerate() {
            for (joint, limits) in joints.iter().enumerate() {
                let at = |field, fault| LimitError::of_joint(leg, joint, field, fault);
                let [least, greatest] = limits.angle;
                for (field, value, is_possible) in [
                    (LimitField::Torque, limits.torque, limits.torque > T::zero()),
                    (LimitField::Angle, least, least < greatest),
                    (LimitField::Angle, greatest, least < greatest),
                    (LimitField::Rate, limits.rate, limits.rate > T::zero()),
                ] {
                    possible(value, is_possible).map_err(|fault| at(field, fault))?;
                }
            }
        }
        for (field, value, _) in thresholds.fields() {
            let is_possible = match field {
                LimitField::Upright => value > -T::one() && value < T::one(),
                LimitField::Gross => value >= T::one(),
                LimitField::Doubtful | LimitField::Bridged | LimitField::LookAhead => {
                    value >= T::zero()
                }
                _ => value > T::zero(),
            };
            let checked = possible(value, is_possible);
            checked.map_err(|fault| LimitError::of_robot(field, fault))?;
        }
        Ok(())
    }

    /// Whether others may stand in place of those of joints and thresholds, none of which may allow
    /// more: what a robot's own description allows, no message can widen.
    ///
    /// # Errors
    /// The first that cannot be a limit, or that is wider than it is here.
    pub fn allows(
        &self,
        joints: &[[JointLimits<T>; LEG]; LEGS],
        thresholds: &Thresholds<T>,
    ) -> Result<(), LimitError> {
        Self::check_both(joints, thresholds)?;
        for (leg, (own, other)) in self.joints.iter().zip(joints).enumerate() {
            for (joint, (own, other)) in own.iter().zip(other).enumerate() {
                let ([least, greatest], [low, high]) = (own.angle, other.angle);
                for (field, is_within) in [
                    (LimitField::Torque, other.torque <= own.torque),
                    (LimitField::Angle, low >= least && high <= greatest),
                    (LimitField::Rate, other.rate <= own.rate),
                ] {
                    if !is_within {
                        return Err(LimitError::of_joint(leg, joint, field, LimitFault::Widens));
                    }
                }
            }
        }
        for ((field, own, tighter), (_, other, _)) in
            self.thresholds.fields().into_iter().zip(thresholds.fields())
        {
            let is_within = match tighter {
                Tighter::Less => other <= own,
                Tighter::More => other >= own,
            };
            if !is_within {
                return Err(LimitError::of_robot(field, LimitFault::Widens));
            }
        }
        Ok(())
    }
}

fn possible<T: Real>(value: T, is_possible: bool) -> Result<(), LimitFault> {
    match (value.is_finite(), is_possible) {
        (false, _) => Err(LimitFault::NotFinite),
        (true, false) => Err(LimitFault::OutOfRange),
        (true, true) => Ok(()),
    }
}

/// Which way a threshold is the tighter one.
#[derive(Clone, Copy)]
enum Tighter {
    Less,
    More,
}

impl<T: Real> Thresholds<T> {
    fn fields(&self) -> [(LimitField, T, Tighter); 16] {
        use LimitField as F;
        use Tighter::{Less, More};
        let count = |ticks: u8| T::of(f64::from(ticks));
        [
            (F::AngleNoise, self.angle_noise, Less),
            (F::RateStep, self.rate_step, Less),
            (F::VelocityStep, self.velocity_step, Less),
            (F::AngularVelocityStep, self.angular_velocity_step, Less),
            (F::Gross, self.gross, Less),
            (F::FrozenAngle, self.frozen_angle, Less),
            (F::Doubtful, count(self.doubtful_ticks), Less),
            (F::TorqueStep, self.torque_step, Less),
            (F::Bridged, count(self.bridged_ticks), Less),
            (F::Recovery, count(self.recovery_ticks), More),
            (F::Upright, self.least_upright, More),
            (F::Drop, self.drop, Less),
            (F::LookAhead, self.look_ahead_s, More),
            (F::FreeFall, self.free_fall, Less),
            (F::FreeFallTime, self.free_fall_s, Less),
            (F::SaturationTime, self.saturation_s, Less),
        ]
    }
}

//! Which limit cannot be one, and why.

/// A number among [`SafetyLimits`](super::SafetyLimits).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[allow(missing_docs)] // Each is the field of that name.
pub enum LimitField {
    Torque,
    Angle,
    Rate,
    Damping,
    Inertia,
    Stop,
    AngleNoise,
    RateStep,
    VelocityStep,
    AngularVelocityStep,
    Gross,
    FrozenAngle,
    Doubtful,
    TorqueStep,
    Bridged,
    Recovery,
    Upright,
    Drop,
    LookAhead,
    FreeFall,
    FreeFallTime,
    SaturationTime,
    /// Seconds between ticks, which come with the limits.
    Period,
}

/// What is wrong with a limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum LimitFault {
    /// NaN or infinite.
    NotFinite,
    /// No limit can have this value.
    OutOfRange,
    /// It allows more than the robot's own limit.
    Widens,
}

/// The first limit that cannot be taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LimitError {
    /// Numbers of leg and joint, for a limit of one joint.
    pub joint: Option<(usize, usize)>,
    /// Which limit.
    pub field: LimitField,
    /// What is wrong with it.
    pub fault: LimitFault,
}

impl LimitError {
    pub(super) fn of_joint(leg: usize, joint: usize, field: LimitField, fault: LimitFault) -> Self {
        Self { joint: Some((leg, joint)), field, fault }
    }

    pub(super) fn of_robot(field: LimitField, fault: LimitFault) -> Self {
        Self { joint: None, field, fault }
    }
}

impl core::fmt::Display for LimitField {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Torque => "torque",
            Self::Angle => "angle",
            Self::Rate => "rate",
            Self::Damping => "damping",
            Self::Inertia => "inertia",
            Self::Stop => "stop_s",
            Self::AngleNoise => "angle_noise",
            Self::RateStep => "rate_step",
            Self::VelocityStep => "velocity_step",
            Self::AngularVelocityStep => "angular_velocity_step",
            Self::Gross => "gross",
            Self::FrozenAngle => "frozen_angle",
            Self::Doubtful => "doubtful_ticks",
            Self::TorqueStep => "torque_step",
            Self::Bridged => "bridged_ticks",
            Self::Recovery => "recovery_ticks",
            Self::Upright => "least_upright",
            Self::Drop => "drop",
            Self::LookAhead => "look_ahead_s",
            Self::FreeFall => "free_fall",
            Self::FreeFallTime => "free_fall_s",
            Self::SaturationTime => "saturation_s",
            Self::Period => "period",
        })
    }
}

impl core::fmt::Display for LimitError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "the limit {}", self.field)?;
        if let Some((leg, joint)) = self.joint {
            write!(f, " of leg {leg}'s joint {joint}")?;
        }
        f.write_str(match self.fault {
            LimitFault::NotFinite => " is not finite",
            LimitFault::OutOfRange => " is out of range",
            LimitFault::Widens => " allows more than the robot's own",
        })
    }
}

impl core::error::Error for LimitError {}

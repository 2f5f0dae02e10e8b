//! What goes to the motors, whatever the tick says: limits, and a safe way to stop.
//!
//! ```text
//!            arm                       a reason to stop                    ramp ends
//! Standby ─────────► Active ──────────────────────────────► Stopping ─────────────────► Stopped
//!    ▲ zero torques    │ torques of the tick, within limits   │ last torques, faded out    │ zero torques
//!    └─────────────────┴───────────── disarm ─────────────────┴────────────────────────────┘
//! ```
//! The safe state is [`Mode::Stopping`] and what follows it: the torques last sent fade to zero, in
//! equal steps over [`SafetyLimits::stop_ticks`] ticks, without a look at any sensor, since sensors
//! may be what failed. Only [`Supervisor::arm`] leads out of [`Mode::Stopped`].

use super::robot::LEG;
use super::{Command, Controller, Fault, Reference, RobotState, tick};
use crate::Real;
use crate::spatial::Quaternion;

/// What motors and sensors can do, and when to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SafetyLimits<T> {
    /// Largest torque of each joint, hip to foot, N·m. Larger ones are cut, and counted.
    pub joint_torque: [T; LEG],
    /// Largest angle that an encoder can read, rad.
    pub joint_angle: T,
    /// Largest rate that an encoder can read, rad/s.
    pub joint_rate: T,
    /// Smallest cosine of the central body's tilt.
    pub least_upright: T,
    /// How far a joint's angle may be from where its rates led it since the last tick, rad. A joint
    /// that moves faster than this per tick is known for frozen at the first tick.
    pub encoder_slack: T,
    /// Ticks in a row without a measurement that are bridged by holding the torques.
    pub bridged_ticks: u8,
    /// Ticks over which the torques fade when stopping; at least 1.
    pub stop_ticks: u16,
}

impl<T: Real> SafetyLimits<T> {
    /// For the biped of §4.1, whose text gives none: torques twice the largest of Experiment 1 at the
    /// knee, tilt to 60°, one lost measurement bridged, a stop of 100 ticks.
    pub fn biped() -> Self {
        Self {
            joint_torque: [200.0, 300.0, 100.0, 400.0, 200.0, 200.0].map(T::of),
            joint_angle: T::of(6.4),
            joint_rate: T::of(200.0),
            least_upright: T::of(0.5),
            encoder_slack: T::of(5e-4),
            bridged_ticks: 1,
            stop_ticks: 100,
        }
    }
}

/// What the supervisor is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Mode {
    /// Not asked to do anything: zero torques.
    Standby,
    /// Balancing.
    Active,
    /// Fading out.
    Stopping {
        /// Ticks until the torques are zero.
        left: u16,
    },
    /// Stopped for a reason: zero torques until armed again.
    Stopped,
}

/// Why the supervisor stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum StopReason {
    /// The tick gave a fault.
    Tick(Fault),
    /// No measurement for more ticks in a row than are bridged.
    Stale,
    /// The tick before took longer than its period.
    Overrun,
    /// An encoder reads what it cannot: angle or rate out of its range.
    Encoder {
        /// Number of the leg.
        leg: usize,
        /// Number of the joint, from 0 at the hip.
        joint: usize,
    },
    /// An encoder's angle does not follow its rate.
    Frozen {
        /// Number of the leg.
        leg: usize,
        /// Number of the joint, from 0 at the hip.
        joint: usize,
    },
    /// The central body is tilted too far.
    Tilt,
}

/// What one step gives.
#[derive(Clone, Copy, Debug)]
pub struct Supervised<T, const LEGS: usize> {
    /// To the motors: finite and within limits in every mode, N·m.
    pub joint_torques: [[T; LEG]; LEGS],
    /// The tick's answer, where there was one.
    pub command: Option<Command<T, LEGS>>,
}

/// The safety state of one robot.
#[derive(Clone, Copy, Debug)]
pub struct Supervisor<T, const LEGS: usize> {
    limits: SafetyLimits<T>,
    /// Seconds between ticks.
    period: T,
    mode: Mode,
    reason: Option<StopReason>,
    /// Last sent in `Active`; what fades in `Stopping`.
    torques: [[T; LEG]; LEGS],
    /// Angles and rates one tick ago.
    previous: Option<[[[T; LEG]; LEGS]; 2]>,
    missed: u8,
    cut: u32,
}

impl<T: Real, const LEGS: usize> Supervisor<T, LEGS> {
    /// In standby, for ticks `period` seconds apart.
    pub fn new(limits: SafetyLimits<T>, period: T) -> Self {
        Self {
            limits,
            period,
            mode: Mode::Standby,
            reason: None,
            torques: [[T::zero(); LEG]; LEGS],
            previous: None,
            missed: 0,
            cut: 0,
        }
    }

    /// Begins to balance, from standby or after a stop; while fading out it has no effect.
    pub fn arm(&mut self) {
        if matches!(self.mode, Mode::Standby | Mode::Stopped) {
            *self =
                Self { mode: Mode::Active, cut: self.cut, ..Self::new(self.limits, self.period) };
        }
    }

    /// Back to standby: torques are zero from the next step on.
    pub fn disarm(&mut self) {
        *self = Self { cut: self.cut, ..Self::new(self.limits, self.period) };
    }

    /// What it is doing.
    pub fn mode(&self) -> Mode {
        self.mode
    }

    /// Why it stopped, until it is armed again.
    pub fn reason(&self) -> Option<StopReason> {
        self.reason
    }

    /// Joint torques cut to their limits so far.
    pub fn cut_torques(&self) -> u32 {
        self.cut
    }

    /// One tick: `measured` is what arrived since the last, `overran` whether that took longer than
    /// its period.
    ///
    /// # Cost
    /// [`tick`] and about 200 operations more; less in every mode but [`Mode::Active`].
    #[inline]
    pub fn step(
        &mut self,
        controller: &Controller<'_, T, LEGS>,
        measured: Option<&RobotState<T, LEGS>>,
        reference: &Reference<T>,
        overran: bool,
    ) -> Supervised<T, LEGS> {
        let mut supervised = Supervised { joint_torques: [[T::zero(); LEG]; LEGS], command: None };
        if self.mode == Mode::Active
            && let Err(reason) =
                self.active(controller, measured, reference, overran, &mut supervised.command)
        {
            self.reason = Some(reason);
            self.mode = Mode::Stopping { left: self.limits.stop_ticks.max(1) };
            supervised.command = None;
        }
        match self.mode {
            Mode::Active => supervised.joint_torques = self.torques,
            Mode::Standby | Mode::Stopped => {}
            Mode::Stopping { left } => supervised.joint_torques = self.fade(left),
        }
        supervised
    }

    /// The torques of a tick, into `self.torques`, and its answer into `command`. Where a measurement is
    /// missing, the torques stay those of the tick before.
    #[inline(always)]
    fn active(
        &mut self,
        controller: &Controller<'_, T, LEGS>,
        measured: Option<&RobotState<T, LEGS>>,
        reference: &Reference<T>,
        overran: bool,
        command: &mut Option<Command<T, LEGS>>,
    ) -> Result<(), StopReason> {
        if overran {
            return Err(StopReason::Overrun);
        }
        let Some(state) = measured else {
            self.missed = self.missed.saturating_add(1);
            // Over more than one period the check below would not hold.
            self.previous = None;
            let is_bridged = self.missed <= self.limits.bridged_ticks;
            return if is_bridged { Ok(()) } else { Err(StopReason::Stale) };
        };
        self.missed = 0;
        self.check_encoders(state)?;
        let command = command.insert(tick(controller, state, reference).map_err(StopReason::Tick)?);
        if !(upright(&state.orientation) >= self.limits.least_upright) {
            return Err(StopReason::Tilt);
        }
        self.torques = command.joint_torques;
        for leg in &mut self.torques {
            for (torque, limit) in leg.iter_mut().zip(self.limits.joint_torque) {
                if !(torque.abs() <= limit) {
                    *torque = if *torque < T::zero() { -limit } else { limit };
                    self.cut = self.cut.saturating_add(1);
                }
            }
        }
        Ok(())
    }

    /// Angles and rates within the encoders' range, and angles where the rates led them:
    /// `θ ≈ θ' + h (ω + ω')/2`, to the slack and half the rate's change.
    #[inline(always)]
    fn check_encoders(&mut self, state: &RobotState<T, LEGS>) -> Result<(), StopReason> {
        let limits = &self.limits;
        let half_period = self.period * T::of(0.5);
        let all = state.joint_angles.iter().zip(&state.joint_rates).enumerate();
        for (leg, (angles, rates)) in all {
            for (joint, (angle, rate)) in angles.iter().zip(rates).enumerate() {
                // NaN and infinity end here too, with the joint's number.
                if !(angle.abs() <= limits.joint_angle && rate.abs() <= limits.joint_rate) {
                    return Err(StopReason::Encoder { leg, joint });
                }
                let before = self.previous.as_ref().and_then(|[angles, rates]| {
                    Some((*angles.get(leg)?.get(joint)?, *rates.get(leg)?.get(joint)?))
                });
                if let Some((angle_before, rate_before)) = before {
                    let expected = angle_before + half_period * (*rate + rate_before);
                    let allowed = limits.encoder_slack + half_period * (*rate - rate_before).abs();
                    if !((*angle - expected).abs() <= allowed) {
                        return Err(StopReason::Frozen { leg, joint });
                    }
                }
            }
        }
        self.previous = Some([state.joint_angles, state.joint_rates]);
        Ok(())
    }

    #[inline(always)]
    fn fade(&mut self, left: u16) -> [[T; LEG]; LEGS] {
        let left = left.saturating_sub(1);
        let share = T::of(f64::from(left)) / T::of(f64::from(self.limits.stop_ticks.max(1)));
        self.mode = if left == 0 { Mode::Stopped } else { Mode::Stopping { left } };
        self.torques.map(|leg| leg.map(|torque| torque * share))
    }
}

/// Cosine of the tilt: the `zz` entry of the rotation matrix.
#[inline(always)]
fn upright<T: Real>(q: &Quaternion<T>) -> T {
    T::one() - T::of(2.0) * (q.v.x * q.v.x + q.v.y * q.v.y)
}

impl core::fmt::Display for StopReason {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Tick(fault) => write!(f, "{fault}"),
            Self::Stale => f.write_str("no fresh measurement"),
            Self::Overrun => f.write_str("a tick took longer than its period"),
            Self::Encoder { leg, joint } => {
                write!(f, "the encoder of leg {leg}'s joint {joint} reads out of its range")
            }
            Self::Frozen { leg, joint } => {
                write!(f, "the encoder of leg {leg}'s joint {joint} does not follow its rate")
            }
            Self::Tilt => f.write_str("the central body is tilted too far"),
        }
    }
}

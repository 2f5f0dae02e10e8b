//! What goes to the motors, whatever the tick says: limits, doubt, and a safe way to stop.
//!
//! ```text
//!            arm                       a reason to stop                   stop_s later
//! Standby ─────────► Active ──────────────────────────────► Stopping ─────────────────► Stopped
//!    ▲ zero torques    │ torques of the tick, within limits   │ motors brake               │ zero torques
//!    └─────────────────┴───────────── disarm ─────────────────┴────────────────────────────┘
//! ```
//! # A measurement
//! - that fits the one before (`consistency`) acts in full;
//! - that fits it badly is *doubtful*: it may be an impact, or a reading gone wrong, and one tick
//!   does not tell which. Torques go at most [`Thresholds::torque_step`] towards what it asks for, and
//!   after [`Thresholds::doubtful_ticks`] such ticks in a row the robot stops;
//! - that cannot be stops it at once;
//! - that is missing is bridged by the torques before, for [`Thresholds::bridged_ticks`], and if it is
//!   not too often.
//!
//! # The robot
//! It is stopped before it is lost (`posture`): tilted or sunk too far, by prediction; in free fall; or
//! with motors at their limits for longer than a robot on its feet has them there.
//!
//! # The stop
//! In [`Mode::Stopping`] motors brake (`stop`): they take energy out of the motion and put none in,
//! whatever of the sensors has failed. Only [`Supervisor::arm`] leads out of [`Mode::Stopped`].

mod consistency;
mod limit_error;
mod limits;
mod memory;
mod posture;
mod reason;
mod stop;

pub use limit_error::{LimitError, LimitFault, LimitField};
pub use limits::{JointDamping, JointLimits, SafetyLimits, Thresholds};
pub use memory::{Before, SupervisorMemory};
pub use reason::StopReason;

use super::robot::LEG;
use super::{Command, Controller, Fault, Reference, RobotState, tick};
use crate::Real;

/// What the supervisor is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Mode {
    /// Not asked to do anything: zero torques.
    Standby,
    /// Balancing.
    Active,
    /// Braking.
    Stopping {
        /// Ticks until the torques are zero.
        left: u16,
    },
    /// Stopped for a reason: zero torques until armed again.
    Stopped,
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
    limits: SafetyLimits<T, LEGS>,
    /// Seconds between ticks.
    period: T,
    /// Of each joint in a stop, N·m·s/rad.
    damping: [[T; LEG]; LEGS],
    /// Times among the limits, in ticks.
    stop_ticks: u16,
    free_fall_ticks: u16,
    saturation_ticks: u16,
    /// Whether the next tick is of a leap that is wanted.
    leaps: bool,
    memory: SupervisorMemory<T, LEGS>,
}

impl<T: Real, const LEGS: usize> Supervisor<T, LEGS> {
    /// In standby, for ticks `period` seconds apart.
    ///
    /// # Errors
    /// A [`LimitError`] for a number that cannot be a limit, or a period that is not positive.
    pub fn new(limits: SafetyLimits<T, LEGS>, period: T) -> Result<Self, LimitError> {
        limits.check()?;
        let mut supervisor = Self {
            damping: [[T::zero(); LEG]; LEGS],
            stop_ticks: 1,
            free_fall_ticks: 1,
            saturation_ticks: 1,
            leaps: false,
            limits,
            period,
            memory: SupervisorMemory::new(0),
        };
        supervisor.set_period(period)?;
        Ok(supervisor)
    }

    /// Back to standby, with limits of joints and thresholds that are tighter than the robot's `own`, or
    /// the same, and another period. In place, as all of it is large.
    ///
    /// # Errors
    /// A [`LimitError`] for a limit that is none, or that is wider. Nothing has changed then.
    pub fn tighten(
        &mut self,
        own: &SafetyLimits<T, LEGS>,
        joints: &[[JointLimits<T>; LEG]; LEGS],
        thresholds: &Thresholds<T>,
        period: T,
    ) -> Result<(), LimitError> {
        own.allows(joints, thresholds)?;
        // Before anything changes, and with what has changed.
        self.set_period(period)?;
        self.limits.joints = *joints;
        self.limits.thresholds = *thresholds;
        self.set_period(period)?;
        self.disarm();
        Ok(())
    }

    fn set_period(&mut self, period: T) -> Result<(), LimitError> {
        if !(period > T::zero() && period.is_finite()) {
            return Err(LimitError::of_robot(LimitField::Period, LimitFault::OutOfRange));
        }
        // To the nearest, and at least one.
        let ticks = |seconds: T| (seconds.to_f64() / period.to_f64() + 0.5).max(1.0) as u16;
        self.period = period;
        self.stop_ticks = ticks(self.limits.stop_s);
        self.free_fall_ticks = ticks(self.limits.thresholds.free_fall_s);
        self.saturation_ticks = ticks(self.limits.thresholds.saturation_s);
        for (held, joints) in self.damping.iter_mut().zip(&self.limits.damping) {
            for (held, joint) in held.iter_mut().zip(joints) {
                *held = stop::held_damping(joint, period);
            }
        }
        Ok(())
    }

    /// Begins to balance, from standby or after a stop; while stopping it has no effect.
    pub fn arm(&mut self) {
        if matches!(self.memory.mode, Mode::Standby | Mode::Stopped) {
            self.disarm();
            self.memory.mode = Mode::Active;
        }
    }

    /// Stops the robot for a reason that is known elsewhere, such as
    /// [`StopReason::Estimate`]: the next step brakes. Only while it balances.
    pub fn stop(&mut self, reason: StopReason) {
        if self.memory.mode == Mode::Active {
            self.memory.reason = Some(reason);
            self.memory.mode = Mode::Stopping { left: self.stop_ticks };
        }
    }

    /// Back to standby: torques are zero from the next step on.
    pub fn disarm(&mut self) {
        self.memory = SupervisorMemory::new(self.memory.cut);
    }

    /// What it is doing.
    pub fn mode(&self) -> Mode {
        self.memory.mode
    }

    /// Why it stopped, until it is armed again.
    pub fn reason(&self) -> Option<StopReason> {
        self.memory.reason
    }

    /// Joint torques cut to their limits so far.
    pub fn cut_torques(&self) -> u32 {
        self.memory.cut
    }

    /// What it remembers.
    pub fn memory(&self) -> &SupervisorMemory<T, LEGS> {
        &self.memory
    }

    /// Goes on with what another one of the same limits remembered.
    pub fn remember(&mut self, memory: SupervisorMemory<T, LEGS>) {
        self.memory = memory;
    }

    /// The limits that it keeps.
    pub fn limits(&self) -> &SafetyLimits<T, LEGS> {
        &self.limits
    }

    /// Says before a tick that the robot is leaping as it is to: in that tick a body that falls freely is not lost, and
    /// tilt and height are judged where they are, not where their rates lead. Who says so bounds the time of a leap.
    pub fn expect_leap(&mut self) {
        self.leaps = true;
    }

    /// One tick: `measured` is what arrived since the last, `overran` whether that took longer than
    /// its period.
    ///
    /// # Cost
    /// [`tick`] and about 50 operations a joint more; less in every mode but [`Mode::Active`].
    #[inline]
    pub fn step(
        &mut self,
        controller: &Controller<'_, T, LEGS>,
        measured: Option<&RobotState<T, LEGS>>,
        reference: &Reference<T>,
        overran: bool,
    ) -> Supervised<T, LEGS> {
        self.step_with(measured, reference, overran, |now| tick(controller, now, reference))
    }

    /// The same with another tick, such as [`limited_tick`](super::limited_tick): what it answers to a
    /// measurement that is believed. It is not called in any other case.
    ///
    /// # Cost
    /// As [`step`](Self::step).
    #[inline]
    pub fn step_with(
        &mut self,
        measured: Option<&RobotState<T, LEGS>>,
        reference: &Reference<T>,
        overran: bool,
        tick: impl FnOnce(&RobotState<T, LEGS>) -> Result<Command<T, LEGS>, Fault>,
    ) -> Supervised<T, LEGS> {
        if self.memory.mode == Mode::Active {
            let mut command = None;
            match self.active(tick, measured, reference, overran, &mut command) {
                Ok(()) => return Supervised { joint_torques: self.memory.torques, command },
                Err(reason) => {
                    self.memory.reason = Some(reason);
                    self.memory.mode = Mode::Stopping { left: self.stop_ticks };
                }
            }
        }
        let joint_torques = match self.memory.mode {
            Mode::Stopping { left } => self.brake(measured, left),
            _ => [[T::zero(); LEG]; LEGS],
        };
        Supervised { joint_torques, command: None }
    }

    /// The torques of a tick, into memory, and its answer into `command`. Where a measurement is
    /// missing, the torques stay those of the tick before.
    #[inline(always)]
    fn active(
        &mut self,
        tick: impl FnOnce(&RobotState<T, LEGS>) -> Result<Command<T, LEGS>, Fault>,
        measured: Option<&RobotState<T, LEGS>>,
        reference: &Reference<T>,
        overran: bool,
        command: &mut Option<Command<T, LEGS>>,
    ) -> Result<(), StopReason> {
        if overran {
            return Err(StopReason::Overrun);
        }
        let Some(now) = measured.filter(|now| !self.memory.repeats(now)) else {
            return self.bridge();
        };
        let is_doubtful = self.check(now, reference)?;
        let command = command.insert(tick(now).map_err(StopReason::Tick)?);
        let step = is_doubtful.then_some(self.limits.thresholds.torque_step);
        self.memory.drive(&command.joint_torques, &self.limits.joints, step);
        if self.memory.saturated >= self.saturation_ticks {
            return Err(self.saturated(&command.joint_torques));
        }
        Ok(())
    }

    /// A tick without a measurement.
    #[cold]
    fn bridge(&mut self) -> Result<(), StopReason> {
        let Thresholds { bridged_ticks, recovery_ticks, .. } = self.limits.thresholds;
        let memory = &mut self.memory;
        memory.missed = memory.missed.saturating_add(1);
        memory.owed = memory.owed.saturating_add(recovery_ticks.into());
        // Two bridges may begin before the first is made up for; a third may not.
        let most = (u16::from(bridged_ticks) + 1).saturating_mul(recovery_ticks.into());
        let is_bridged = memory.missed <= bridged_ticks && memory.owed <= most;
        if is_bridged { Ok(()) } else { Err(StopReason::Stale) }
    }

    /// Whether a measurement is doubtful; and remembers it.
    #[inline(always)]
    fn check(
        &mut self,
        now: &RobotState<T, LEGS>,
        reference: &Reference<T>,
    ) -> Result<bool, StopReason> {
        let leaps = core::mem::take(&mut self.leaps);
        let Self { limits, memory, period, .. } = self;
        let thresholds = &limits.thresholds;
        let look_ahead = if leaps { T::zero() } else { thresholds.look_ahead_s };
        consistency::in_range(&limits.joints, now)?;
        posture::tilt(thresholds, look_ahead, now)?;
        let velocity = now.orientation.rotate(now.velocity.linear);
        memory.highest = Some(posture::height(
            thresholds,
            look_ahead,
            memory.highest,
            reference.position.z,
            [now.position.z, velocity.z],
        )?);
        let mut is_doubtful = false;
        let mut unexplained = [[0; 4]; LEGS];
        if let Some(before) = &memory.before {
            let h = memory.elapsed(*period);
            let joints = consistency::joints(thresholds, before, now, h)?;
            is_doubtful = consistency::body(thresholds, before, now, velocity, h)?;
            is_doubtful |= joints.is_doubtful;
            let bits = joints.unexplained.iter().zip(&before.unexplained);
            for (to, (latest, [a, b, c, _])) in unexplained.iter_mut().zip(bits) {
                *to = [*latest, *a, *b, *c];
            }
            let falls = velocity.z - before.velocity.z < -thresholds.free_fall * h;
            memory.falling = if falls && !leaps { memory.falling.saturating_add(1) } else { 0 };
        }
        match &mut memory.before {
            // In place: it is large.
            Some(before) => {
                before.state = *now;
                before.velocity = velocity;
                before.unexplained = unexplained;
            }
            None => memory.before = Some(Before { state: *now, velocity, unexplained }),
        }
        memory.missed = 0;
        memory.owed = memory.owed.saturating_sub(1);
        memory.doubtful = if is_doubtful { memory.doubtful.saturating_add(1) } else { 0 };
        if memory.falling >= self.free_fall_ticks {
            return Err(StopReason::FreeFall);
        }
        if memory.doubtful > thresholds.doubtful_ticks {
            return Err(StopReason::Doubtful);
        }
        Ok(is_doubtful)
    }

    /// The first joint whose torque is cut.
    #[cold]
    fn saturated(&self, wanted: &[[T; LEG]; LEGS]) -> StopReason {
        for (leg, (wanted, limits)) in wanted.iter().zip(&self.limits.joints).enumerate() {
            for (joint, (wanted, limits)) in wanted.iter().zip(limits).enumerate() {
                if wanted.abs() > limits.torque {
                    return StopReason::Saturated { leg, joint };
                }
            }
        }
        StopReason::Saturated { leg: 0, joint: 0 }
    }

    /// One tick of the stop.
    #[inline(never)]
    fn brake(&mut self, measured: Option<&RobotState<T, LEGS>>, left: u16) -> [[T; LEG]; LEGS] {
        let left = left.saturating_sub(1);
        let mut torques = [[T::zero(); LEG]; LEGS];
        let memory = &mut self.memory;
        memory.mode = if left == 0 { Mode::Stopped } else { Mode::Stopping { left } };
        let Some(now) = measured else {
            memory.missed = memory.missed.saturating_add(1);
            return torques;
        };
        let half = T::of(0.5) * T::of(f64::from(self.stop_ticks));
        let share = T::of(f64::from(left)) / half;
        let share = if share > T::one() { T::one() } else { share };
        if let Some(before) = &memory.before {
            let h = memory.elapsed(self.period);
            let blamed = memory.reason.and_then(|reason| reason.blamed());
            let joints = &self.limits.joints;
            torques = stop::braking(&self.damping, joints, (before, h), now, share, blamed);
        }
        let before =
            Before { state: *now, velocity: now.velocity.linear, unexplained: [[0; 4]; LEGS] };
        memory.before = Some(before);
        memory.missed = 0;
        torques
    }
}

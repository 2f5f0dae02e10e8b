//! What a step leaves for the next.

use super::limits::JointLimits;
use super::stop::within;
use super::{Mode, StopReason};
use crate::Real;
use crate::balance::RobotState;
use crate::balance::robot::LEG;
use nalgebra::Vector3;

/// A measurement, for the next one to be compared with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Before<T, const LEGS: usize> {
    /// As it was measured.
    pub state: RobotState<T, LEGS>,
    /// The central body's velocity in the world, m/s.
    pub velocity: Vector3<T>,
    /// Joints of each leg whose residual no step of a rate explained, at this measurement and at those
    /// before it, the latest first: one bit a joint.
    pub unexplained: [[u8; 4]; LEGS],
}

/// All that a supervisor remembers. One with the same limits, given it, goes on to the same bits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SupervisorMemory<T, const LEGS: usize> {
    /// What it is doing.
    pub mode: Mode,
    /// Why it stopped.
    pub reason: Option<StopReason>,
    /// Torques last sent in [`Mode::Active`], N·m.
    pub torques: [[T; LEG]; LEGS],
    /// The last measurement; none before the first.
    pub before: Option<Before<T, LEGS>>,
    /// Ticks since, less one.
    pub missed: u8,
    /// What measurements that were missing have added and others taken off, in ticks.
    pub owed: u16,
    /// Ticks in a row that were doubtful.
    pub doubtful: u8,
    /// Ticks in a row in which the central body fell freely.
    pub falling: u16,
    /// Ticks in a row in which a torque was cut.
    pub saturated: u16,
    /// The lower of the reference's height and of the greatest since it was armed, m.
    pub highest: Option<T>,
    /// Torques cut to their limits so far.
    pub cut: u32,
}

/// A joint that moves more slowly than this may read the same twice, rad/s.
const RESTING: f64 = 1e-3;

impl<T: Real, const LEGS: usize> SupervisorMemory<T, LEGS> {
    /// In standby, with nothing to remember but what was cut.
    pub(super) fn new(cut: u32) -> Self {
        Self {
            mode: Mode::Standby,
            reason: None,
            torques: [[T::zero(); LEG]; LEGS],
            before: None,
            missed: 0,
            owed: 0,
            doubtful: 0,
            falling: 0,
            saturated: 0,
            highest: None,
            cut,
        }
    }

    /// Seconds since the last measurement. No more additions than ticks that were bridged.
    #[inline(always)]
    pub(super) fn elapsed(&self, period: T) -> T {
        (0..self.missed).fold(period, |seconds, _| seconds + period)
    }

    /// Whether a measurement is the last one once more, to the last bit, while it says that joints
    /// move: then no sensor has made it.
    #[inline(always)]
    pub(super) fn repeats(&self, now: &RobotState<T, LEGS>) -> bool {
        let moves = |rate: &T| rate.abs() > T::of(RESTING);
        // One number first: it is enough for nearly all.
        let is_same = |before: &Before<T, LEGS>| {
            before.state.position.x == now.position.x && before.state == *now
        };
        self.before.as_ref().is_some_and(is_same) && now.joint_rates.iter().flatten().any(moves)
    }

    /// Takes a tick's torques as motors get them: within `limits`, and where there is a `step`, no
    /// farther than that from those before.
    #[inline(always)]
    pub(super) fn drive(
        &mut self,
        wanted: &[[T; LEG]; LEGS],
        limits: &[[JointLimits<T>; LEG]; LEGS],
        step: Option<T>,
    ) {
        let mut cut = 0;
        for ((torques, wanted), limits) in self.torques.iter_mut().zip(wanted).zip(limits) {
            for ((torque, wanted), limits) in torques.iter_mut().zip(wanted).zip(limits) {
                let mut given = *wanted;
                if given.abs() > limits.torque {
                    given = within(given, limits.torque);
                    cut += 1;
                }
                if let Some(step) = step
                    && (given - *torque).abs() > step
                {
                    given = *torque + within(given - *torque, step);
                }
                *torque = given;
            }
        }
        self.cut = self.cut.saturating_add(cut);
        self.saturated = if cut > 0 { self.saturated.saturating_add(1) } else { 0 };
    }
}

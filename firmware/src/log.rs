//! What the robot was doing, and why it stopped, kept over resets.

use crate::no_init;
use surefoot::balance::{Mode, StopReason};
use surefoot_link::{FaultLog, LoggedFault};

/// The log, and its copy in memory that a reset leaves alone.
pub struct Log(FaultLog);

impl Log {
    /// Reads what has survived, and notes this reset and what led to it.
    pub fn open() -> Self {
        let mut log = no_init::read();
        log.resets = log.resets.saturating_add(1);
        if let Some(crash) = no_init::read_crash() {
            log.crashes = log.crashes.saturating_add(1);
            log.crash = Some(crash);
        }
        no_init::write(&log);
        no_init::forget_crash();
        Self(log)
    }

    /// All of it.
    pub fn contents(&self) -> &FaultLog {
        &self.0
    }

    /// The mode that the next reset may find. The ramp's ticks are one mode.
    pub fn note_mode(&mut self, mode: Mode) {
        let mode = match mode {
            Mode::Stopping { .. } => Mode::Stopping { left: 0 },
            other => other,
        };
        if self.0.mode_at_reset != Some(mode) {
            self.0.mode_at_reset = Some(mode);
            no_init::write(&self.0);
        }
    }

    /// A stop at this tick.
    pub fn note_stop(&mut self, tick: u32, reason: StopReason) {
        if self.0.stops.is_full() {
            self.0.stops.remove(0);
        }
        // There is room now.
        let _ = self.0.stops.push(LoggedFault { reset: self.0.resets, tick, reason });
        no_init::write(&self.0);
        defmt::error!("stopped at tick {=u32}: {}", tick, defmt::Display2Format(&reason));
    }
}

//! What a target reports of itself: its clock, its counts, and its log.

use crate::Tally;
use heapless::Vec;
use serde::{Deserialize, Serialize};
use surefoot::balance::{Mode, StopReason};

/// What a target is clocked by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Clock {
    /// A crystal of this many MHz.
    Crystal(u8),
    /// The chip's own oscillator, of some per cent, which the line may not bear.
    Internal(NoCrystal),
    /// An emulator's.
    Emulated,
}

/// Why a target does without its crystal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum NoCrystal {
    /// It does not oscillate.
    Silent,
    /// It has this many kHz, to some per cent, which no crystal has that the board knows.
    Unknown(u16),
    /// The clock's multiplier does not follow it.
    Unlocked,
}

/// Counts and logs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Status {
    /// Mode now.
    pub mode: Mode,
    /// Frames received, by kind.
    pub received: Tally,
    /// Records of ticks that found the telemetry queue full.
    pub telemetry_dropped: u32,
    /// Measurements in whose place a tick took a newer one.
    pub measurements_replaced: u32,
    /// Measurements that had been on their way for too long, or came again.
    pub measurements_stale: u32,
    /// What the UART found wrong.
    pub line: LineErrors,
    /// Ticks that took longer than their period.
    pub overruns: u32,
    /// Torques cut to their limits.
    pub cut_torques: u32,
    /// Deepest the stack has been, bytes.
    pub stack_bytes: u32,
    /// What has survived resets.
    pub log: FaultLog,
}

/// What a UART has found wrong since the reset, in bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct LineErrors {
    /// Came before the last was taken; at least this many are lost.
    pub overrun: u32,
    /// Without a stop bit: another baud rate, or a break.
    pub framing: u32,
    /// With samples of a bit that differ.
    pub noise: u32,
    /// Of the wrong parity, where the line has any.
    pub parity: u32,
    /// Came while the queue to the application was full.
    pub unqueued: u32,
}

/// The log that survives a reset.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FaultLog {
    /// Resets seen.
    pub resets: u32,
    /// Mode in which the last reset came.
    pub mode_at_reset: Option<Mode>,
    /// Last stops, oldest first.
    pub stops: Vec<LoggedFault, 8>,
    /// Resets after a [`Crash`].
    pub crashes: u32,
    /// The last of them.
    pub crash: Option<Crash>,
}

/// What the program ended of, with motors off and a reset.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Crash {
    /// A panic, at this line of some file.
    Panic {
        /// Line.
        line: u32,
    },
    /// A hard fault, or a memory, bus or usage fault, which become hard faults.
    HardFault {
        /// Address of the instruction.
        at: u32,
        /// Configurable Fault Status Register (ARMv7-M B3.2.15), which names the kind.
        status: u32,
    },
    /// An exception (below 0; −14 is a crystal that has failed) or an interrupt that nothing handles.
    Unhandled {
        /// Its number.
        number: i16,
    },
}

/// One stop.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct LoggedFault {
    /// Number of the reset before it.
    pub reset: u32,
    /// Tick since that reset.
    pub tick: u32,
    /// Why.
    pub reason: StopReason,
}

impl core::fmt::Display for NoCrystal {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Silent => f.write_str("it does not oscillate"),
            Self::Unknown(khz) => write!(f, "about {khz} kHz is none that the board knows"),
            Self::Unlocked => f.write_str("the clock's multiplier does not follow it"),
        }
    }
}

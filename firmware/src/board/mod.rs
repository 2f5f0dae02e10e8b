//! The board: everything that another one would do differently.
//!
//! To change board, write a file like `stm32f405.rs` for its chip, put its device crate into
//! `Cargo.toml` and its memory into `memory.x`, and name its timer's and UART's interrupts where
//! `main.rs` says `binds`.

mod stm32f405;
mod stm32f4_clock;

#[cfg(feature = "emulation")]
mod emulation;
#[cfg(not(feature = "emulation"))]
mod hardware;

#[cfg(feature = "emulation")]
pub use emulation::{Counter, Link, TickTimer, due, exit, log, sleep_unless};
#[cfg(feature = "emulation")]
use emulation::{MICROSECOND, link};
#[cfg(not(feature = "emulation"))]
pub use hardware::{Counter, Link, TickTimer, log, sleep_unless};
#[cfg(not(feature = "emulation"))]
use hardware::{MICROSECOND, link};
pub use stm32f405::{
    Board, ByteQueue, Motors, UartReceiver, Watchdog, device, line_errors, motors_off, now_us,
    restart, tick_now,
};
use surefoot_firmware::watchdog::LONGEST_PERIOD_US;
use surefoot_link::Pacing;

/// Longest period that timer and watchdog can do, µs.
pub const LONGEST_US: u32 = if TickTimer::LONGEST_US < LONGEST_PERIOD_US {
    TickTimer::LONGEST_US
} else {
    LONGEST_PERIOD_US
};

impl Counter {
    /// Cost that a tick may have which is due every `period` seconds.
    #[inline(always)]
    pub fn deadline(pacing: Pacing, period: f32) -> u32 {
        let per_second = match pacing {
            Pacing::LockStep => Self::LOCK_STEP_PER_SECOND,
            Pacing::FreeRunning => Self::PER_SECOND,
        };
        (period * per_second as f32) as u32
    }
}

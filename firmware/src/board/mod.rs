//! The board: everything that another one would do differently.
//!
//! To change board, write a file like `stm32f405.rs` for its chip, put its device crate and a feature for it into
//! `Cargo.toml` and its memory into `memory/`, and name its timer's and UART's interrupts where `main.rs` says
//! `binds`. Boards that run in an emulator alone have their exceptions in their own file (`mps2.rs`).

#[cfg(feature = "stm32f405")]
mod stm32f405;
#[cfg(feature = "stm32f405")]
mod stm32f4_clock;

#[cfg(all(feature = "stm32f405", feature = "emulation"))]
mod emulation;
#[cfg(not(feature = "emulation"))]
mod hardware;
#[cfg(any(feature = "mps2-an500", feature = "mps2-an505"))]
mod mps2;
#[cfg(feature = "mps2-an500")]
mod mps2_an500;
#[cfg(feature = "mps2-an505")]
mod mps2_an505;
#[cfg(feature = "emulation")]
mod pipes;
#[cfg(feature = "virt-rv32")]
mod rv32_interrupts;
#[cfg(all(feature = "emulation", target_arch = "arm"))]
mod systick;
#[cfg(feature = "virt-rv32")]
mod virt_rv32;

#[cfg(all(feature = "stm32f405", feature = "emulation"))]
pub use emulation::due;
#[cfg(all(feature = "stm32f405", feature = "emulation"))]
use emulation::{MICROSECOND, NANOSECONDS, SYSTICK_HZ, tick_timer};
#[cfg(not(feature = "emulation"))]
pub use hardware::{Counter, Link, TickTimer, log, sleep_unless};
#[cfg(not(feature = "emulation"))]
use hardware::{MICROSECOND, link, tick_timer};
#[cfg(any(feature = "mps2-an500", feature = "mps2-an505"))]
pub use mps2::{Board, Motors, Watchdog, line_errors, motors_off, now_us, restart};
#[cfg(any(feature = "mps2-an500", feature = "mps2-an505"))]
use mps2::{Uart, pend_tick};
#[cfg(feature = "mps2-an500")]
use mps2_an500::{FPGA_IO, NANOSECONDS, SYSTICK_HZ, UART_0};
#[cfg(feature = "mps2-an505")]
use mps2_an505::{FPGA_IO, NANOSECONDS, SYSTICK_HZ, UART_0};
#[cfg(feature = "emulation")]
use pipes::link;
#[cfg(feature = "emulation")]
pub use pipes::{Link, exit, log, sleep_unless};
#[cfg(all(feature = "stm32f405", feature = "emulation"))]
use stm32f405::Uart;
#[cfg(feature = "stm32f405")]
use stm32f405::pend_tick;
#[cfg(feature = "stm32f405")]
pub use stm32f405::{
    Board, ByteQueue, Motors, UartReceiver, Watchdog, device, line_errors, motors_off, now_us,
    restart,
};
#[cfg(all(feature = "emulation", target_arch = "arm"))]
pub use systick::{Counter, TickTimer};
#[cfg(feature = "virt-rv32")]
pub use virt_rv32::{
    Board, Counter, Motors, TickTimer, Watchdog, line_errors, motors_off, now_us, restart,
};
#[cfg(feature = "virt-rv32")]
use virt_rv32::{Uart, pend_tick};

use core::sync::atomic::{AtomicU32, Ordering};
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

/// When the present tick was due, in lock step.
static DUE: AtomicU32 = AtomicU32::new(0);

/// Runs the tick at once.
pub fn tick_now(counter: Counter) {
    DUE.store(counter.now(), Ordering::Relaxed);
    pend_tick();
}

/// Cost since [`tick_now`].
#[inline(always)]
fn since_due(counter: Counter) -> u32 {
    counter.since(DUE.load(Ordering::Relaxed))
}

//! On a real chip: ticks by TIM2, cycles by the debug unit's counter, link by UART, logs by RTT.

use super::since_due;
use super::stm32f405::{Uart, device};
use core::cell::UnsafeCell;
use cortex_m::peripheral::DWT;
use rtt_target::{ChannelMode, UpChannel, rtt_init};
use surefoot_firmware::sleep::{self, Processor};

/// Clock of the core, Hz.
const CORE_HZ: u32 = 168_000_000;

/// Clock of TIM2: APB1's, doubled (RM0090, §7.2).
const TIMER_HZ: u32 = 84_000_000;

/// Counts of TIM5's clock in a µs: APB1's, doubled.
pub const MICROSECOND: u16 = 84;

/// Makes ticks due.
pub struct TickTimer {
    registers: device::TIM2,
    counter: Counter,
}

impl TickTimer {
    /// Longest period, µs: 2³² counts.
    pub const LONGEST_US: u32 = ((1_u64 << 32) * 1_000_000 / TIMER_HZ as u64) as u32;

    /// A tick every `period` seconds.
    pub fn run(&mut self, period: f32) {
        let reload = ((period * TIMER_HZ as f32) as u32).saturating_sub(1);
        // SAFETY: TIM2 counts to any 32-bit number.
        self.registers.arr().write(|w| unsafe { w.bits(reload) });
        self.registers.cnt().reset();
        self.registers.cr1().write(|w| w.cen().set_bit());
    }

    /// No ticks but `tick_now`'s.
    pub fn halt(&mut self) {
        self.registers.cr1().reset();
    }

    /// Takes note that a tick has begun.
    ///
    /// # Returns
    /// The cost between its being due and now.
    #[inline(always)]
    pub fn acknowledge(&mut self) -> u32 {
        self.registers.sr().reset();
        if self.registers.cr1().read().cen().bit_is_clear() {
            return since_due(self.counter);
        }
        // It began anew when the tick was due.
        self.registers.cnt().read().bits().saturating_mul(CORE_HZ / TIMER_HZ)
    }
}

/// Not running yet.
pub fn tick_timer(registers: device::TIM2, counter: Counter) -> TickTimer {
    registers.dier().write(|w| w.uie().set_bit());
    TickTimer { registers, counter }
}

/// Counts clock cycles.
#[derive(Clone, Copy)]
pub struct Counter(());

impl Counter {
    /// What costs are counted in.
    pub const UNIT: surefoot_link::Counter = surefoot_link::Counter::Cycles;
    /// Cost of a second.
    pub const PER_SECOND: u32 = CORE_HZ;
    /// The same in lock step.
    pub const LOCK_STEP_PER_SECOND: u32 = CORE_HZ;

    /// Turns the counter on.
    pub fn start(mut core: cortex_m::Peripherals) -> Self {
        core.DCB.enable_trace();
        core.DWT.enable_cycle_counter();
        Self(())
    }

    /// A moment.
    #[inline(always)]
    pub fn now(self) -> u32 {
        DWT::cycle_count()
    }

    /// Cost since a moment.
    #[inline(always)]
    pub fn since(self, begin: u32) -> u32 {
        DWT::cycle_count().wrapping_sub(begin)
    }
}

/// The UART.
pub type Link = Uart;

/// Also opens the channel for logs.
pub fn link(uart: Uart) -> Link {
    let channels = rtt_init! {
        up: { 0: { size: 2048, mode: ChannelMode::NoBlockSkip, name: "defmt" } }
    };
    // SAFETY: before the first log message, and with interrupts off, as in all of `init`.
    unsafe { *LOG.0.get() = Some(channels.up.0) };
    uart
}

/// Sleeps until an interrupt, unless there is work.
pub fn sleep_unless(has_work: impl FnOnce() -> bool) {
    sleep::sleep_unless(&Core, has_work);
}

struct Core;

impl Processor for Core {
    fn masked(&self, run: impl FnOnce()) {
        cortex_m::interrupt::free(|_| run());
    }

    fn wait(&self) {
        // Memory is up to date before the core stops.
        cortex_m::asm::dsb();
        cortex_m::asm::wfi();
    }
}

struct Log(UnsafeCell<Option<UpChannel>>);

// SAFETY: written by `init`, and used by idle alone.
unsafe impl Sync for Log {}

static LOG: Log = Log(UnsafeCell::new(None));

/// Logs, or leaves out what finds no room.
pub fn log(bytes: &[u8]) {
    // SAFETY: only idle logs.
    if let Some(channel) = unsafe { &mut *LOG.0.get() } {
        channel.write(bytes);
    }
}

//! Ticks, and costs in instructions, of an emulated Cortex-M, by SysTick.
//!
//! The debug unit's cycle counter stands still in QEMU. With `-icount shift=n` an instruction takes 2ⁿ ns of the
//! machine's time, which the board gives as [`NANOSECONDS`]. SysTick counts more than twice in that, so that the
//! number of instructions can be told exactly.

use super::{NANOSECONDS, SYSTICK_HZ, since_due};
use core::sync::atomic::{AtomicU32, Ordering};
use cortex_m::peripheral::SYST;
use cortex_m::peripheral::syst::SystClkSource;

/// Counts of SysTick in 1000 instructions.
const COUNTS: u64 = NANOSECONDS * SYSTICK_HZ / 1_000_000;
const _: () = assert!(COUNTS > 2000 && (NANOSECONDS * SYSTICK_HZ).is_multiple_of(1_000_000));
/// SysTick counts down from here, and over: from its largest, or over one period.
static RELOAD: AtomicU32 = AtomicU32::new(0x00ff_ffff);

/// Makes ticks due. SysTick does it in place of a timer of the chip: its exception pends the tick.
pub struct TickTimer {
    counter: Counter,
    is_running: bool,
}

impl TickTimer {
    /// Longest period, µs: 2²⁴ counts.
    pub const LONGEST_US: u32 = ((1 << 24) as f32 / SYSTICK_HZ as f32 * 1e6) as u32;

    /// Not running yet.
    pub fn new(counter: Counter) -> Self {
        Self { counter, is_running: false }
    }

    /// A tick every `period` seconds.
    pub fn run(&mut self, period: f32) {
        let reload = ((period * SYSTICK_HZ as f32) as u32).clamp(1, 0x00ff_ffff) - 1;
        RELOAD.store(reload, Ordering::Relaxed);
        // SAFETY: SysTick is the emulated board's clock, which `Counter` only reads.
        let mut systick = unsafe { cortex_m::Peripherals::steal() }.SYST;
        systick.set_reload(reload);
        systick.clear_current();
        systick.enable_interrupt();
        self.is_running = true;
    }

    /// No ticks but `tick_now`'s. A free-running target stays one, so that there is nothing to stop.
    pub fn halt(&mut self) {}

    /// Takes note that a tick has begun.
    ///
    /// # Returns
    /// The cost between its being due and now.
    #[inline(always)]
    pub fn acknowledge(&mut self) -> u32 {
        if self.is_running {
            self.counter.since(RELOAD.load(Ordering::Relaxed))
        } else {
            since_due(self.counter)
        }
    }
}

/// Counts instructions.
#[derive(Clone, Copy)]
pub struct Counter(());

impl Counter {
    /// What costs are counted in.
    pub const UNIT: surefoot_link::Counter = surefoot_link::Counter::Instructions;
    /// Cost of a second.
    pub const PER_SECOND: u32 = (1_000_000_000 / NANOSECONDS) as u32;
    /// Where the emulator's time is nobody's, a tick may take what it may on the reference board: 168 MHz, at five
    /// cycles for three instructions.
    pub const LOCK_STEP_PER_SECOND: u32 = 100_800_000;

    /// Turns the counter on.
    pub fn start(mut core: cortex_m::Peripherals) -> Self {
        core.SYST.set_clock_source(SystClkSource::Core);
        core.SYST.set_reload(RELOAD.load(Ordering::Relaxed));
        core.SYST.clear_current();
        core.SYST.enable_counter();
        Self(())
    }

    /// A moment.
    #[inline(always)]
    pub fn now(self) -> u32 {
        SYST::get_current()
    }

    /// Cost since a moment, of at most 5 million, or one period of a free-running target.
    #[inline(always)]
    pub fn since(self, begin: u32) -> u32 {
        let now = SYST::get_current();
        let over = if now > begin { RELOAD.load(Ordering::Relaxed) + 1 } else { 0 };
        let counts = begin + over - now;
        ((u64::from(counts) * 1000 + COUNTS / 2) / COUNTS) as u32
    }

    /// Passes time.
    pub fn wait(self, cost: u32) {
        let begin = self.now();
        while self.since(begin) < cost {}
    }
}

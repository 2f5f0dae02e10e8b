//! In QEMU's netduinoplus2, by semihosting: costs in instructions, link over two named pipes or the
//! UART, logs on QEMU's standard output.
//!
//! QEMU must run with `-icount shift=4`, where an instruction takes 16 ns of the machine's time. The
//! debug unit's cycle counter stands still there; SysTick, at 168 MHz, counts 2.688 an instruction, and
//! as that is more than two, the number of instructions can be told exactly.

use super::stm32f405::{Uart, device, since_due};
use core::sync::atomic::{AtomicU32, Ordering};
use cortex_m::peripheral::SYST;
use cortex_m::peripheral::syst::SystClkSource;
use semihosting::fs::File;
use semihosting::io::{Read, Write};

/// Counts of SysTick in 1000 instructions: 16 ns · 168 MHz · 1000.
const COUNTS: u64 = 2688;
/// SysTick, Hz.
const SYSTICK_HZ: f32 = 168e6;
/// Counts of TIM5's clock in a µs: QEMU's timers have 1 GHz.
pub const MICROSECOND: u16 = 1000;
/// SysTick counts down from here, and over: from its largest, or over one period.
static RELOAD: AtomicU32 = AtomicU32::new(0x00ff_ffff);

/// Makes ticks due. QEMU's TIM2 does not repeat, so SysTick does it: its exception calls [`due`].
pub struct TickTimer {
    counter: Counter,
    is_running: bool,
}

impl TickTimer {
    /// Longest period, µs: 2²⁴ counts.
    pub const LONGEST_US: u32 = ((1 << 24) as f32 / SYSTICK_HZ * 1e6) as u32;

    /// Not running yet.
    pub fn new(_: device::TIM2, counter: Counter) -> Self {
        Self { counter, is_running: false }
    }

    /// A tick every `period` seconds.
    pub fn run(&mut self, period: f32) {
        let reload = ((period * SYSTICK_HZ) as u32).clamp(1, 0x00ff_ffff) - 1;
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

/// What SysTick's exception does.
pub fn due() {
    rtic::pend(device::Interrupt::TIM2);
}

/// Counts instructions.
#[derive(Clone, Copy)]
pub struct Counter(());

impl Counter {
    /// What costs are counted in.
    pub const UNIT: surefoot_link::Counter = surefoot_link::Counter::Instructions;
    /// Cost of a second: 16 ns each.
    pub const PER_SECOND: u32 = 62_500_000;
    /// Where the emulator's time is nobody's, a tick may take what it may on the board: 168 MHz, at five cycles
    /// for three instructions.
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

    /// Cost since a moment, of at most 6 million, or one period of a free-running target.
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

/// Two pipes where the emulator's folder has them, and the UART otherwise.
pub enum Link {
    /// From the host, and to it.
    Pipes(File, File),
    /// As on hardware.
    Uart(Uart),
}

/// Looks for the pipes.
pub fn link(uart: Uart) -> Link {
    let from_host = File::open(c"to-target");
    let to_host = File::create(c"to-host");
    match (from_host, to_host) {
        (Ok(from_host), Ok(to_host)) => Link::Pipes(from_host, to_host),
        _ => Link::Uart(uart),
    }
}

impl Link {
    /// Whether something has arrived. Over pipes that is known by waiting for it.
    pub fn has_bytes(&self) -> bool {
        match self {
            Self::Pipes(..) => true,
            Self::Uart(uart) => uart.has_bytes(),
        }
    }

    /// What has arrived. Over pipes the machine stands still until something does.
    pub fn receive(&mut self, buffer: &mut [u8]) -> usize {
        match self {
            Self::Pipes(from_host, _) => match from_host.read(buffer) {
                // Nobody is at the other end any more.
                Ok(0) | Err(_) => exit(),
                Ok(received) => received,
            },
            Self::Uart(uart) => uart.receive(buffer),
        }
    }

    /// Sends all bytes.
    pub fn send(&mut self, bytes: &[u8]) {
        match self {
            Self::Pipes(_, to_host) => {
                if to_host.write_all(bytes).is_err() {
                    exit();
                }
            }
            Self::Uart(uart) => uart.send(bytes),
        }
    }
}

/// Does not sleep: an emulator that sleeps lets time go by the clock on the wall.
pub fn sleep_unless(_: impl FnOnce() -> bool) {}

/// Ends the emulator.
pub fn exit() -> ! {
    semihosting::process::exit(0)
}

/// Logs.
pub fn log(bytes: &[u8]) {
    if let Ok(mut out) = semihosting::io::stdout() {
        let _ = out.write_all(bytes);
    }
}

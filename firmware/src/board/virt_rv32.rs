//! QEMU's virt for RISC-V, with an RV32IMAFC core: costs in instructions by `minstret`.
//!
//! | what | where |
//! |---|---|
//! | tick | interrupts of the core: its timer's, and software's in lock step |
//! | link | a 16550 UART, which idle asks for its bytes: QEMU holds back those that find no room |
//! | µs | the core's timer, 10 MHz |
//!
//! There is no pin for the motors here, no watchdog, and no interrupt of the UART: these are shown on the reference
//! board. With `-icount shift=0` QEMU's `minstret` counts instructions (it reads the machine's ns).

use super::{Link, link, since_due};
use crate::robot::{ROW, ROWS};
use core::sync::atomic::{AtomicU32, Ordering};
use riscv::register::{mie, minstret};
use surefoot_link::{Clock, LineErrors};

/// Of the core: pending software interrupt, when its timer's is due, and time (RISC-V ACLINT, chapters 2 and 3).
const SOFTWARE: usize = 0x0200_0000;
const DUE_LOW: usize = 0x0200_4000;
const DUE_HIGH: usize = 0x0200_4004;
const TIME_LOW: usize = 0x0200_bff8;
const TIME_HIGH: usize = 0x0200_bffc;
/// Rate of that time, Hz.
const TIMER_HZ: u32 = 10_000_000;
/// What a write of this does to the machine: a reset.
const RESET: (usize, u32) = (0x0010_0000, 0x7777);
/// The UART: data, line status (bit 0: something received, bit 5: room to send).
const UART_DATA: usize = 0x1000_0000;
const UART_STATUS: usize = 0x1000_0005;

/// The board's parts, each for one owner.
pub struct Board {
    /// For the tick.
    pub timer: TickTimer,
    /// For everyone.
    pub counter: Counter,
    /// For the tick.
    pub motors: Motors,
    /// For the tick.
    pub watchdog: Watchdog,
    /// For idle.
    pub link: Link,
    /// QEMU has no clock tree.
    pub clock: Clock,
}

impl Board {
    /// Sets up the interrupts of software; `plain.rs` turns interrupts on.
    pub fn start() -> Self {
        let counter = Counter(());
        // SAFETY: handlers are in `rv32_interrupts.rs`, and the tick's state is there before interrupts are turned on.
        unsafe { mie::set_msoft() };
        Self {
            timer: TickTimer { counter, period: 0 },
            counter,
            motors: Motors(()),
            watchdog: Watchdog(()),
            link: link(Uart(())),
            clock: Clock::Emulated,
        }
    }
}

fn read(register: usize) -> u32 {
    // SAFETY: a word of this board's that reading does not change.
    unsafe { (register as *const u32).read_volatile() }
}

fn write(register: usize, value: u32) {
    // SAFETY: a word of this board's; none of them moves memory.
    unsafe { (register as *mut u32).write_volatile(value) };
}

/// Of the core's timer.
fn time() -> u64 {
    loop {
        let (high, low) = (read(TIME_HIGH), read(TIME_LOW));
        if read(TIME_HIGH) == high {
            return u64::from(high) << 32 | u64::from(low);
        }
    }
}

fn set_due(at: u64) {
    // Not due in between (section 3.2 of the manual).
    write(DUE_HIGH, u32::MAX);
    write(DUE_LOW, at as u32);
    write(DUE_HIGH, (at >> 32) as u32);
}

/// µs since the reset.
#[inline(always)]
pub fn now_us() -> u32 {
    (time() / u64::from(TIMER_HZ / 1_000_000)) as u32
}

/// Makes ticks due.
pub struct TickTimer {
    counter: Counter,
    /// Counts of the core's timer; none where it does not run.
    period: u32,
}

/// When the tick is due next, by the timer's low word.
static NEXT: AtomicU32 = AtomicU32::new(0);

impl TickTimer {
    /// Longest period, µs: 2³⁰ counts.
    pub const LONGEST_US: u32 = (1 << 30) / (TIMER_HZ / 1_000_000);

    /// A tick every `period` seconds.
    pub fn run(&mut self, period: f32) {
        self.period = ((period * TIMER_HZ as f32) as u32).max(1);
        let next = time() + u64::from(self.period);
        NEXT.store(next as u32, Ordering::Relaxed);
        set_due(next);
        // SAFETY: its handler is there, and the tick that runs is the one that turns it on.
        unsafe { mie::set_mtimer() };
    }

    /// No ticks but `tick_now`'s.
    pub fn halt(&mut self) {
        self.period = 0;
        // SAFETY: nothing waits for it.
        unsafe { mie::clear_mtimer() };
    }

    /// Takes note that a tick has begun.
    ///
    /// # Returns
    /// The cost between its being due and now.
    #[inline(always)]
    pub fn acknowledge(&mut self) -> u32 {
        write(SOFTWARE, 0);
        if self.period == 0 {
            return since_due(self.counter);
        }
        let now = time();
        let late = (now as u32).wrapping_sub(NEXT.load(Ordering::Relaxed));
        let next = now - u64::from(late) + u64::from(self.period);
        NEXT.store(next as u32, Ordering::Relaxed);
        set_due(next);
        late.saturating_mul(Counter::PER_SECOND / TIMER_HZ)
    }
}

/// Counts instructions.
#[derive(Clone, Copy)]
pub struct Counter(());

impl Counter {
    /// What costs are counted in.
    pub const UNIT: surefoot_link::Counter = surefoot_link::Counter::Instructions;
    /// Cost of a second: a nanosecond each.
    pub const PER_SECOND: u32 = 1_000_000_000;
    /// As the reference board's: 168 MHz, at five cycles for three instructions.
    pub const LOCK_STEP_PER_SECOND: u32 = 100_800_000;

    /// A moment.
    #[inline(always)]
    pub fn now(self) -> u32 {
        minstret::read() as u32
    }

    /// Cost since a moment.
    #[inline(always)]
    pub fn since(self, begin: u32) -> u32 {
        self.now().wrapping_sub(begin)
    }

    /// Passes time.
    pub fn wait(self, cost: u32) {
        let begin = self.now();
        while self.since(begin) < cost {}
    }
}

/// Runs the tick at once.
#[inline(always)]
pub fn pend_tick() {
    write(SOFTWARE, 1);
    // Until it has run, which clears it: the store need not have reached the core's own register by now.
    while read(SOFTWARE) != 0 {}
}

/// Where torques go. This board has neither drives nor a pin for them: the link carries torques.
pub struct Motors(());

impl Motors {
    /// Torques in N·m, by leg from hip to foot.
    #[inline(always)]
    pub fn set(&mut self, _joint_torques: &[[f32; ROW]; ROWS], _is_enabled: bool) {}
}

/// Nothing to turn off.
pub fn motors_off() {}

/// None.
pub struct Watchdog(());

impl Watchdog {
    /// Nothing.
    pub fn start(&mut self, _period_us: u32) {}

    /// Nothing.
    #[inline(always)]
    pub fn feed(&mut self) {}
}

/// QEMU's line has no noise.
pub fn line_errors() -> LineErrors {
    LineErrors::default()
}

/// The UART.
pub struct Uart(());

impl Uart {
    fn status(&self) -> u8 {
        // SAFETY: a register of this board; idle alone reads it.
        unsafe { (UART_STATUS as *const u8).read_volatile() }
    }

    /// Whether something has arrived.
    pub fn has_bytes(&self) -> bool {
        self.status() & 1 != 0
    }

    /// What has arrived.
    pub fn receive(&mut self, buffer: &mut [u8]) -> usize {
        let mut received = 0;
        for place in buffer.iter_mut() {
            if !self.has_bytes() {
                break;
            }
            // SAFETY: as above.
            *place = unsafe { (UART_DATA as *const u8).read_volatile() };
            received += 1;
        }
        received
    }

    /// Waits while the line is busy.
    pub fn send(&mut self, bytes: &[u8]) {
        for byte in bytes {
            while self.status() & 1 << 5 == 0 {}
            // SAFETY: as above.
            unsafe { (UART_DATA as *mut u8).write_volatile(*byte) };
        }
    }
}

/// Resets the machine. Memory keeps its contents.
pub fn restart() -> ! {
    let (register, value) = RESET;
    write(register, value);
    loop {
        riscv::asm::wfi();
    }
}

//! What QEMU's MPS2 boards have in common. Registers are those of Arm's CMSDK (DDI 0479, chapter 4) and of the
//! FPGA's I/O block (application note AN505, section 4.7).
//!
//! | what | where |
//! |---|---|
//! | tick | exception PendSV, which SysTick or lock step pends |
//! | link | UART 0, which idle asks for its bytes: QEMU holds back those that find no room |
//! | motor enable | LED 0, lit while torques may differ from zero |
//! | µs | the FPGA's counter |
//!
//! There is no watchdog here, and no interrupt of the UART: both are shown on the reference board.

use super::systick::{Counter, TickTimer};
use super::{FPGA_IO, Link, SYSTICK_HZ, UART_0, link};
use crate::robot::{ROW, ROWS};
use cortex_m::peripheral::SCB;
use cortex_m_rt::exception;
use surefoot_link::{Clock, LineErrors};

/// Registers of the UART, in words: data, state (bit 0: no room to send, bit 1: something received), control
/// (bits 0 and 1: send, receive), interrupts, divider.
const DATA: usize = 0;
const STATE: usize = 1;
const CONTROL: usize = 2;
const DIVIDER: usize = 4;
/// Registers of the I/O block, in words: LEDs, counter, and what divides its clock.
const LEDS: usize = 0;
const COUNTER: usize = 6;
const PRESCALE: usize = 7;

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
    /// Sets up the peripherals.
    pub fn start(core: cortex_m::Peripherals) -> Self {
        let counter = Counter::start(core);
        write(FPGA_IO, PRESCALE, (SYSTICK_HZ / 1_000_000 - 1) as u32);
        write(FPGA_IO, LEDS, 0);
        // The smallest divider there is; QEMU's line takes no time.
        write(UART_0, DIVIDER, 16);
        write(UART_0, CONTROL, 0b11);
        Self {
            timer: TickTimer::new(counter),
            counter,
            motors: Motors(()),
            watchdog: Watchdog(()),
            link: link(Uart(())),
            clock: Clock::Emulated,
        }
    }
}

fn read(base: usize, word: usize) -> u32 {
    // SAFETY: a register of this board, which reading changes at most as `Uart`, its only reader, wants.
    unsafe { (base as *const u32).add(word).read_volatile() }
}

fn write(base: usize, word: usize, value: u32) {
    // SAFETY: a register of this board; none of them moves memory.
    unsafe { (base as *mut u32).add(word).write_volatile(value) };
}

/// µs since the reset.
#[inline(always)]
pub fn now_us() -> u32 {
    read(FPGA_IO, COUNTER)
}

/// Runs the tick at once: idle runs at no exception's priority.
#[inline(always)]
pub fn pend_tick() {
    SCB::set_pendsv();
    cortex_m::asm::dsb();
    cortex_m::asm::isb();
}

#[exception]
fn SysTick() {
    SCB::set_pendsv();
}

#[exception]
fn PendSV() {
    crate::plain::tick();
}

/// Where torques go. This board has no drives: a LED says whether there may be torques, and the link carries them.
pub struct Motors(());

impl Motors {
    /// Torques in N·m, by leg from hip to foot.
    #[inline(always)]
    pub fn set(&mut self, _joint_torques: &[[f32; ROW]; ROWS], is_enabled: bool) {
        write(FPGA_IO, LEDS, u32::from(is_enabled));
    }
}

/// No torque, at once and from anywhere: the safe state of this board.
pub fn motors_off() {
    write(FPGA_IO, LEDS, 0);
}

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

/// UART 0.
pub struct Uart(());

impl Uart {
    /// Whether something has arrived.
    pub fn has_bytes(&self) -> bool {
        read(UART_0, STATE) & 0b10 != 0
    }

    /// What has arrived.
    pub fn receive(&mut self, buffer: &mut [u8]) -> usize {
        let mut received = 0;
        for place in buffer.iter_mut() {
            if !self.has_bytes() {
                break;
            }
            *place = read(UART_0, DATA) as u8;
            received += 1;
        }
        received
    }

    /// Waits while the line is busy.
    pub fn send(&mut self, bytes: &[u8]) {
        for byte in bytes {
            while read(UART_0, STATE) & 1 != 0 {}
            write(UART_0, DATA, u32::from(*byte));
        }
    }
}

/// Resets the machine. Memory keeps its contents.
pub fn restart() -> ! {
    SCB::sys_reset()
}

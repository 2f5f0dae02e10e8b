//! The reference board in QEMU's netduinoplus2: costs in instructions by SysTick, link over two named pipes or
//! the UART.

use super::stm32f405::device;
use super::systick::{Counter, TickTimer};

/// Of an instruction, with `-icount shift=4`.
pub const NANOSECONDS: u64 = 16;
/// SysTick: the core's clock.
pub const SYSTICK_HZ: u64 = 168_000_000;
/// Counts of TIM5's clock in a µs: QEMU's timers have 1 GHz.
pub const MICROSECOND: u16 = 1000;

/// QEMU's TIM2 does not repeat, so SysTick does it.
pub fn tick_timer(_: device::TIM2, counter: Counter) -> TickTimer {
    TickTimer::new(counter)
}

/// What SysTick's exception does.
pub fn due() {
    rtic::pend(device::Interrupt::TIM2);
}

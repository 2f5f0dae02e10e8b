//! 168 MHz from the board's crystal, or from the chip's own oscillator where there is none (RM0090,
//! sections 7.2 and 7.3).

use super::stm32f405::device;
use surefoot_firmware::clock::{INTERNAL_MHZ, MULTIPLIER, crystal, measured_khz};
use surefoot_link::{Clock, NoCrystal};

/// Reads of a register before what it waits for is given up: at 16 MHz and 6 cycles or more, 0.1 s.
const PATIENCE: u32 = 300_000;

/// What the crystal is divided by before it is measured: as slow as can be.
const DIVIDER: u8 = 31;
/// Periods of that which are measured.
const PERIODS: u32 = 8;

/// Starts the clock. A crystal that stops later raises NMI (section 7.2.7).
pub fn start(rcc: &device::RCC, flash: &device::FLASH, timer: &device::TIM11) -> Clock {
    // Five wait states, for up to 168 MHz at 2.7 V or more (section 3.5.1).
    flash.acr().write(|w| w.latency().ws5().prften().set_bit().icen().set_bit().dcen().set_bit());
    let clock = match start_crystal(rcc, timer) {
        Ok(mhz) if multiply(rcc, mhz, true) => Clock::Crystal(mhz),
        Ok(_) => Clock::Internal(NoCrystal::Unlocked),
        Err(reason) => Clock::Internal(reason),
    };
    if let Clock::Internal(_) = clock {
        // Without it there is no clock to go on with; motors are off.
        while !multiply(rcc, INTERNAL_MHZ, false) {}
    }
    rcc.cfgr().modify(|_, w| w.hpre().div1().ppre1().div4().ppre2().div2());
    rcc.cfgr().modify(|_, w| w.sw().pll());
    while !rcc.cfgr().read().sws().is_pll() {}
    if let Clock::Crystal(_) = clock {
        rcc.cr().modify(|_, w| w.csson().set_bit());
    }
    clock
}

/// Starts the crystal, and finds out which one it is.
fn start_crystal(rcc: &device::RCC, timer: &device::TIM11) -> Result<u8, NoCrystal> {
    rcc.cr().modify(|_, w| w.hseon().set_bit());
    if !comes(|| rcc.cr().read().hserdy().bit_is_set()) {
        rcc.cr().modify(|_, w| w.hseon().clear_bit());
        return Err(NoCrystal::Silent);
    }
    // SAFETY: 2 to 31 divide; the timer's input 2 is the divided crystal (sections 7.3.3 and 19.5.12).
    rcc.cfgr().modify(|_, w| unsafe { w.rtcpre().bits(DIVIDER) });
    rcc.apb2enr().modify(|_, w| w.tim11en().set_bit());
    // SAFETY: as above.
    timer.or().write(|w| unsafe { w.bits(2) });
    // SAFETY: channel 1 is an input, of which each eighth edge is captured (section 19.5.5).
    timer.ccmr1_input().write(|w| unsafe { w.bits(0b1101) });
    timer.ccer().write(|w| w.cc1e().set_bit());
    timer.cr1().write(|w| w.cen().set_bit());
    // The first edge found the counter anywhere.
    let edges = [(); 2].map(|()| {
        let is_there = comes(|| timer.sr().read().cc1if().bit_is_set());
        is_there.then(|| timer.ccr1().read().bits() as u16)
    });
    timer.cr1().reset();
    rcc.apb2enr().modify(|_, w| w.tim11en().clear_bit());
    let [Some(first), Some(second)] = edges else { return Err(NoCrystal::Unknown(0)) };
    let counts = u32::from(second.wrapping_sub(first));
    crystal(measured_khz(u32::from(DIVIDER) * PERIODS, counts))
}

/// Starts the multiplier.
///
/// # Returns
/// Whether it has locked on its input.
fn multiply(rcc: &device::RCC, mhz: u8, is_crystal: bool) -> bool {
    rcc.cr().modify(|_, w| w.pllon().clear_bit());
    comes(|| rcc.cr().read().pllrdy().bit_is_clear());
    // SAFETY: a crystal's MHz, 336 and 7 are within the fields' ranges (section 7.3.2).
    rcc.pllcfgr().write(|w| unsafe {
        w.pllm().bits(mhz).plln().bits(MULTIPLIER).pllp().div2();
        w.pllsrc().bit(is_crystal).pllq().bits(7)
    });
    rcc.cr().modify(|_, w| w.pllon().set_bit());
    comes(|| rcc.cr().read().pllrdy().bit_is_set())
}

fn comes(is_there: impl Fn() -> bool) -> bool {
    (0..PATIENCE).any(|_| is_there())
}

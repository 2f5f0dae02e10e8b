//! Which crystal an STM32F4 has, and how its clock is made from it (RM0090, sections 7.2 and 7.3.2).

use surefoot_link::NoCrystal;

/// Crystals that boards with this chip have, MHz. They are told apart by a measurement of some per
/// cent, so that one of 24 or 26 MHz must stand here alone.
pub const CRYSTALS_MHZ: [u8; 4] = [8, 12, 16, 25];

/// The internal oscillator's frequency, MHz; from −8 to +4.5 % of it from −40 to 105 °C (datasheet).
pub const INTERNAL_MHZ: u8 = 16;

/// How far a measurement by the internal oscillator may be off, of a hundred.
const TOLERANCE: u32 = 10;

/// The clock's multiplier: `f = input / m · 336 / 2`, which is 168 MHz for an input of m MHz. That has
/// 1 MHz before the multiplier, which takes 0.95 to 2.1, and 336 MHz after it, of 100 to 432.
pub const MULTIPLIER: u16 = 336;

/// The crystal that a measurement means.
///
/// # Errors
/// [`NoCrystal::Unknown`], with what was measured.
pub fn crystal(measured_khz: u32) -> Result<u8, NoCrystal> {
    CRYSTALS_MHZ
        .into_iter()
        .find(|mhz| {
            let expected = u32::from(*mhz) * 1000;
            measured_khz.abs_diff(expected) * 100 <= expected * TOLERANCE
        })
        .ok_or(NoCrystal::Unknown(measured_khz.min(u32::from(u16::MAX)) as u16))
}

/// Frequency in kHz of an input of which `cycles` take `counts` of the internal oscillator.
pub fn measured_khz(cycles: u32, counts: u32) -> u32 {
    (u32::from(INTERNAL_MHZ) * 1000 * cycles).checked_div(counts).unwrap_or(0)
}

/// What divides the UART's clock to a baud rate: oversampling by 16, so that the register's fixed-point
/// number is the whole divider (RM0090, section 30.3.4).
///
/// # Panics
/// Where the rate is off by more than a hundredth: at compile time, where this is used.
pub const fn divider(clock_hz: u32, baud: u32) -> u16 {
    let divider = (clock_hz + baud / 2) / baud;
    assert!(divider >= 16 && divider <= 0xffff, "the UART cannot have this rate");
    let off = clock_hz.abs_diff(divider * baud);
    assert!(off <= clock_hz / 100, "the UART's rate is off by more than 1 %");
    divider as u16
}

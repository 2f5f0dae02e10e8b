//! Watchdog, crystal and baud rate: the arithmetic of registers, over all that is accepted.

use surefoot_firmware::clock::{CRYSTALS_MHZ, INTERNAL_MHZ, crystal, divider, measured_khz};
use surefoot_firmware::watchdog::{LONGEST_PERIOD_US, Watchdog};
use surefoot_link::{BAUD, NoCrystal};

/// It never waits for less than three periods, and at the slowest not for absurdly more.
#[test]
fn the_watchdog_covers_every_period() {
    for period_us in (100..5_000).chain((5_000..=1_000_000).step_by(37)).chain([1_000_000]) {
        let watchdog = Watchdog::covering(period_us).expect("it covers a second");
        let (shortest, longest) = watchdog.wait_us();
        let period = u64::from(period_us);
        assert!(shortest >= 3 * period, "{period_us}: {shortest}");
        // Three periods, the oscillator's range of 47 to 17, and one count of a divider.
        let count = (4 << watchdog.prescaler) * 1_000_000 / 17_000 + 2;
        assert!(longest <= 3 * period * 47 / 17 + count, "{period_us}: {longest}");
    }
    assert_eq!(Watchdog::covering(1000), Some(Watchdog { prescaler: 0, reload: 35 }));
    assert_eq!(Watchdog::covering(1000).map(Watchdog::wait_us), Some((3063, 8471)));
    assert_eq!(Watchdog::covering(1_000_000), Some(Watchdog { prescaler: 4, reload: 2203 }));
    assert!(Watchdog::covering(LONGEST_PERIOD_US).is_some());
    assert_eq!(Watchdog::covering(LONGEST_PERIOD_US + 1), None);
}

/// RM0090's own table of waits at 32 kHz (section 21.3.3): 4 … 256 give 512 ms … 32.768 s.
#[test]
fn waits_are_those_of_the_manual() {
    for prescaler in 0..=6 {
        let (shortest, longest) = Watchdog { prescaler, reload: 0xfff }.wait_us();
        let printed = 512_000 << prescaler;
        assert_eq!(shortest, printed * 32 / 47);
        assert_eq!(longest, (printed * 32).div_ceil(17));
    }
}

/// A crystal is known whatever the temperature does to the oscillator that measures it.
#[test]
fn crystals_are_told_apart() {
    // 8 periods of the crystal over 31, counted by 0.92 to 1.045 times 16 MHz.
    const CYCLES: u32 = 8 * 31;
    for mhz in CRYSTALS_MHZ {
        for off in 920..=1045 {
            let counts = f64::from(INTERNAL_MHZ) * f64::from(off) / 1000.0 * f64::from(CYCLES)
                / f64::from(mhz);
            for counts in [counts.floor(), counts.ceil()] {
                assert_eq!(crystal(measured_khz(CYCLES, counts as u32)), Ok(mhz), "{off}");
            }
        }
    }
    assert_eq!(crystal(4000), Err(NoCrystal::Unknown(4000)));
    assert_eq!(crystal(20_000), Err(NoCrystal::Unknown(20_000)));
    assert_eq!(crystal(measured_khz(CYCLES, 0)), Err(NoCrystal::Unknown(0)));
    assert_eq!(crystal(u32::MAX / 200), Err(NoCrystal::Unknown(u16::MAX)));
}

/// RM0090's table of dividers for 84 MHz, oversampled by 16 (section 30.3.4, in sixteenths).
#[test]
fn dividers_are_those_of_the_manual() {
    for (baud, printed) in [(115_200, 45.5625), (230_400, 22.8125), (921_600, 5.6875)] {
        assert_eq!(f64::from(divider(84_000_000, baud)) / 16.0, printed);
    }
    assert_eq!(84_000_000 / u32::from(divider(84_000_000, BAUD)), BAUD, "exactly");
}

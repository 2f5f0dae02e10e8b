//! How long an STM32's independent watchdog must wait for a tick (RM0090, section 21).
//!
//! It counts down from `reload`, at the rate of the chip's slow oscillator over a divider:
//! `t = divider · (reload + 1) / f`, with `divider = 4 · 2^prescaler`. The oscillator has 32 kHz, and by
//! the datasheet anything from 17 to 47 kHz.

/// kHz.
const FASTEST: u32 = 47;
/// kHz.
const SLOWEST: u32 = 17;

/// Periods that it waits at least. Ticks come one period apart, two where one overruns, which is the
/// supervisor's affair; the third is the watchdog's.
const PERIODS: u32 = 3;

/// Largest prescaler, and number of counts.
const MOST: (u8, u32) = (6, 1 << 12);

/// Longest period that it covers, µs: 7.4 s.
pub const LONGEST_PERIOD_US: u32 = (4 << MOST.0) * MOST.1 / (PERIODS * FASTEST) * 1000;

/// What its registers are set to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Watchdog {
    /// Divides by `4 · 2^prescaler`.
    pub prescaler: u8,
    /// Where it counts down from.
    pub reload: u16,
}

impl Watchdog {
    /// The shortest wait that is never less than three periods; nothing if it cannot wait that long.
    ///
    /// 1 ms: 3 ms · 47 kHz / 4 gives 36 counts, which are 3.06 ms at the fastest and 8.47 ms at the
    /// slowest. 1 s: 2204 counts of 64, 3.00 and 8.30 s.
    pub fn covering(period_us: u32) -> Option<Self> {
        if period_us > LONGEST_PERIOD_US {
            return None;
        }
        // µs · kHz: a thousand a count of the oscillator.
        let needed = PERIODS * period_us * FASTEST;
        (0..=MOST.0).find_map(|prescaler| {
            let counts = needed.div_ceil((4 << prescaler) * 1000).max(1);
            (counts <= MOST.1).then(|| Self { prescaler, reload: (counts - 1) as u16 })
        })
    }

    /// Shortest and longest wait, µs, over the oscillator's range.
    pub fn wait_us(self) -> (u64, u64) {
        let thousand = 1000 * (4_u64 << self.prescaler) * (u64::from(self.reload) + 1);
        (thousand / u64::from(FASTEST), thousand.div_ceil(u64::from(SLOWEST)))
    }
}

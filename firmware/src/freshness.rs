//! Whether a measurement is fresh, by two clocks that know nothing of each other.

/// Tells measurements that were long on their way from those that come as fast as they can.
///
/// The lag of a measurement is the time between its being taken, by the sender's clock, and its
/// arrival, by this one's. It is a constant plus what it had to wait. The least lag seen stands for the
/// constant, and may grow slowly, as one clock is slower than the other.
#[derive(Clone, Copy, Debug)]
pub struct Freshness {
    /// Longest wait of a fresh measurement, µs.
    longest_us: u32,
    /// The clocks differ by at most one in this many.
    drift: u32,
    last: Option<Last>,
}

#[derive(Clone, Copy, Debug)]
struct Last {
    taken_us: u32,
    arrived_us: u32,
    least_lag_us: u32,
}

/// A measurement that is no measurement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stale {
    /// Taken before the last one, or the same.
    Repeated,
    /// It has waited for this many µs.
    Late(u32),
}

impl Freshness {
    /// For measurements that may wait for `longest_us`, by clocks that differ by at most one in
    /// `drift`.
    pub const fn new(longest_us: u32, drift: u32) -> Self {
        Self { longest_us, drift, last: None }
    }

    /// Forgets the sender's clock: another sender has another.
    pub fn forget(&mut self) {
        self.last = None;
    }

    /// Accepts a measurement, or says why not. Times go round after 71 minutes; the first after a
    /// silence of more than half of that may be refused.
    ///
    /// # Errors
    /// [`Stale`].
    pub fn accept(&mut self, taken_us: u32, arrived_us: u32) -> Result<(), Stale> {
        let lag = arrived_us.wrapping_sub(taken_us);
        let Some(last) = &mut self.last else {
            self.last = Some(Last { taken_us, arrived_us, least_lag_us: lag });
            return Ok(());
        };
        if !is_after(taken_us, last.taken_us) {
            return Err(Stale::Repeated);
        }
        // Rounded up, so that it never stands still.
        let grown = arrived_us.wrapping_sub(last.arrived_us) / self.drift.max(1) + 1;
        let expected = last.least_lag_us.wrapping_add(grown);
        let waited = if is_after(lag, expected) { lag.wrapping_sub(expected) } else { 0 };
        let least_lag_us = if waited == 0 { lag } else { expected };
        *last = Last { taken_us, arrived_us, least_lag_us };
        if waited > self.longest_us { Err(Stale::Late(waited)) } else { Ok(()) }
    }
}

/// Times go round.
fn is_after(time: u32, other: u32) -> bool {
    let ahead = time.wrapping_sub(other);
    ahead != 0 && ahead <= u32::MAX / 2
}

//! What to make of a byte that an STM32F4's UART has received (RM0090, section 30.3.3 and 30.6.1).
//!
//! RXNE and ORE raise one interrupt. Error flags are cleared by reading the status and then the data,
//! in that order; reading the data alone leaves an overrun standing, and with it the interrupt, for
//! ever.

use core::sync::atomic::{AtomicU32, Ordering};
use surefoot_link::LineErrors;

/// Bits of the status register: parity, framing, noise, overrun, and data to be read.
const PE: u32 = 1;
const FE: u32 = 1 << 1;
const NF: u32 = 1 << 2;
const ORE: u32 = 1 << 3;
const RXNE: u32 = 1 << 5;

/// The registers that matter here.
pub trait Registers {
    /// SR.
    fn status(&self) -> u32;
    /// DR, read.
    fn data(&self) -> u32;
}

/// Counts of what went wrong, written by the interrupt and read by all.
#[derive(Default)]
pub struct Errors {
    overrun: AtomicU32,
    framing: AtomicU32,
    noise: AtomicU32,
    parity: AtomicU32,
    unqueued: AtomicU32,
}

/// Takes what the interrupt is about, and ends it.
///
/// # Returns
/// The byte, if there is one that may be right. One that is noisy may: the frame's checksum judges it.
#[inline(always)]
pub fn receive(registers: &impl Registers, errors: &Errors) -> Option<u8> {
    let status = registers.status();
    let data = registers.data();
    if status & (PE | FE | NF | ORE) != 0 {
        errors.note(status);
    }
    // Without RXNE there was an overrun during the reading before, and this data has been read.
    (status & RXNE != 0 && status & (PE | FE) == 0).then_some(data as u8)
}

impl Errors {
    /// None so far.
    pub const fn new() -> Self {
        Self {
            overrun: AtomicU32::new(0),
            framing: AtomicU32::new(0),
            noise: AtomicU32::new(0),
            parity: AtomicU32::new(0),
            unqueued: AtomicU32::new(0),
        }
    }

    /// A byte found the queue full.
    pub fn note_unqueued(&self) {
        count(&self.unqueued);
    }

    /// All counts.
    pub fn tally(&self) -> LineErrors {
        let of = |count: &AtomicU32| count.load(Ordering::Relaxed);
        LineErrors {
            overrun: of(&self.overrun),
            framing: of(&self.framing),
            noise: of(&self.noise),
            parity: of(&self.parity),
            unqueued: of(&self.unqueued),
        }
    }

    #[cold]
    fn note(&self, status: u32) {
        let all =
            [(ORE, &self.overrun), (FE, &self.framing), (NF, &self.noise), (PE, &self.parity)];
        for (flag, counter) in all {
            if status & flag != 0 {
                count(counter);
            }
        }
    }
}

/// By the only context that writes it.
fn count(counter: &AtomicU32) {
    counter.store(counter.load(Ordering::Relaxed).saturating_add(1), Ordering::Relaxed);
}

//! Log messages that never delay a tick.
//!
//! defmt's usual loggers mask all interrupts while a message goes out. Only idle logs here, so that
//! no lock is needed: a message from an interrupt, which ends before idle goes on, would find the logger
//! taken, and is left out.

use core::sync::atomic::{AtomicU8, Ordering};

#[defmt::global_logger]
struct Logger;

/// Messages begun and not ended: the outermost has the encoder.
static DEPTH: AtomicU8 = AtomicU8::new(0);

mod encoder {
    use core::cell::UnsafeCell;

    /// The encoder of the outermost message.
    pub struct Encoder(UnsafeCell<defmt::Encoder>);

    // SAFETY: used only between `acquire` and `release`, of which there is one pair at a time.
    unsafe impl Sync for Encoder {}

    impl Encoder {
        pub const fn new() -> Self {
            Self(UnsafeCell::new(defmt::Encoder::new()))
        }

        /// # Safety
        /// Only by the outermost message, and not twice at a time.
        #[allow(clippy::mut_from_ref)]
        pub unsafe fn get(&self) -> &mut defmt::Encoder {
            // SAFETY: by the caller.
            unsafe { &mut *self.0.get() }
        }
    }
}

static ENCODER: encoder::Encoder = encoder::Encoder::new();

// SAFETY: only the outermost message reaches the encoder. Those that interrupt it end before it goes on.
unsafe impl defmt::Logger for Logger {
    fn acquire() {
        let depth = DEPTH.load(Ordering::Relaxed);
        DEPTH.store(depth.saturating_add(1), Ordering::Relaxed);
        if depth == 0 {
            // SAFETY: taken above.
            unsafe { ENCODER.get().start_frame(crate::board::log) }
        }
    }

    unsafe fn flush() {}

    unsafe fn release() {
        if is_outermost() {
            // SAFETY: by the caller, who has acquired it.
            unsafe { ENCODER.get().end_frame(crate::board::log) }
        }
        DEPTH.store(DEPTH.load(Ordering::Relaxed).saturating_sub(1), Ordering::Relaxed);
    }

    unsafe fn write(bytes: &[u8]) {
        if is_outermost() {
            // SAFETY: by the caller, who has acquired it.
            unsafe { ENCODER.get().write(bytes, crate::board::log) }
        }
    }
}

fn is_outermost() -> bool {
    DEPTH.load(Ordering::Relaxed) == 1
}

//! Log messages that never delay a tick.
//!
//! defmt's usual loggers mask all interrupts while a message goes out. Only idle logs here, so that
//! no lock is needed: a message from anywhere else would find the logger taken, and be left out.

use core::sync::atomic::{AtomicBool, Ordering};

#[defmt::global_logger]
struct Logger;

static IS_TAKEN: AtomicBool = AtomicBool::new(false);

mod encoder {
    use core::cell::UnsafeCell;

    /// The encoder of whoever has taken the logger.
    pub struct Encoder(UnsafeCell<defmt::Encoder>);

    // SAFETY: used only between `acquire` and `release`, of which there is one pair at a time.
    unsafe impl Sync for Encoder {}

    impl Encoder {
        pub const fn new() -> Self {
            Self(UnsafeCell::new(defmt::Encoder::new()))
        }

        /// # Safety
        /// Only by whoever has taken the logger, and not twice at a time.
        #[allow(clippy::mut_from_ref)]
        pub unsafe fn get(&self) -> &mut defmt::Encoder {
            // SAFETY: by the caller.
            unsafe { &mut *self.0.get() }
        }
    }
}

static ENCODER: encoder::Encoder = encoder::Encoder::new();

// SAFETY: `acquire` gives the encoder to one caller at a time: to idle, which is the only one.
unsafe impl defmt::Logger for Logger {
    fn acquire() {
        IS_TAKEN.store(true, Ordering::Relaxed);
        // SAFETY: taken above.
        unsafe { ENCODER.get().start_frame(crate::board::log) }
    }

    unsafe fn flush() {}

    unsafe fn release() {
        // SAFETY: by the caller, who has acquired it.
        unsafe { ENCODER.get().end_frame(crate::board::log) }
        IS_TAKEN.store(false, Ordering::Relaxed);
    }

    unsafe fn write(bytes: &[u8]) {
        // SAFETY: by the caller, who has acquired it.
        unsafe { ENCODER.get().write(bytes, crate::board::log) }
    }
}

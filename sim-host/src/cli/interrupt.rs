//! Ctrl-C: a run ends at its next sample and keeps what there is; a second one ends the program at once.

use super::output::complain;
use std::sync::Once;
use std::sync::atomic::{AtomicBool, Ordering};

/// What a shell says of a program that SIGINT has ended: 128 and its number.
pub(super) const INTERRUPTED: u8 = 130;

static WAS_ASKED: AtomicBool = AtomicBool::new(false);

/// A flag that is set once the user, or the system, asks the program to end.
pub(super) fn watched() -> &'static AtomicBool {
    static WATCH: Once = Once::new();
    WATCH.call_once(|| {
        // Also where a shell that started it in the background had the signal ignored.
        let watch = ctrlc::set_handler(|| {
            if WAS_ASKED.swap(true, Ordering::Relaxed) {
                std::process::exit(i32::from(INTERRUPTED));
            }
        });
        if let Err(error) = watch {
            complain(format_args!("warning: an interrupted run will be lost: {error}"));
        }
    });
    &WAS_ASKED
}

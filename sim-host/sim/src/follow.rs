//! Who follows a run, and may end it early.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

/// Hears of the time that a run has reached, now and then.
pub trait Follow {
    /// Whether the run goes on from there.
    fn reached(&mut self, time_s: f64) -> ControlFlow<()>;
}

/// A function that only listens.
impl<F: FnMut(f64)> Follow for F {
    fn reached(&mut self, time_s: f64) -> ControlFlow<()> {
        self(time_s);
        ControlFlow::Continue(())
    }
}

/// Ends a run once a flag is set.
pub struct Until<'a, F> {
    /// The flag.
    pub stop: &'a AtomicBool,
    /// Who listens.
    pub follower: F,
}

impl<F: Follow> Follow for Until<'_, F> {
    fn reached(&mut self, time_s: f64) -> ControlFlow<()> {
        if self.stop.load(Ordering::Relaxed) {
            return ControlFlow::Break(());
        }
        self.follower.reached(time_s)
    }
}

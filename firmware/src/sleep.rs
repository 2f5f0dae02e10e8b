//! Sleeping until there is something to do, without missing what comes at the last moment.

/// A processor that can sleep.
pub trait Processor {
    /// Runs this with interrupts held back. They stay pending.
    fn masked(&self, run: impl FnOnce());
    /// Sleeps until an interrupt is pending, also one that is held back (`wfi`, ARMv7-M B1.5.19).
    fn wait(&self);
}

/// Sleeps until an interrupt, unless `has_work` finds something before.
///
/// It looks with interrupts held back: what comes after the look cannot run, stays pending, and ends
/// the sleep. They are held back for as long as a look takes.
#[inline(always)]
pub fn sleep_unless(processor: &impl Processor, has_work: impl FnOnce() -> bool) {
    processor.masked(|| {
        if !has_work() {
            processor.wait();
        }
    });
}

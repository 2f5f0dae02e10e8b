//! An interrupt at every point of falling asleep: none is slept through.

use std::cell::Cell;
use surefoot_firmware::sleep::{Processor, sleep_unless};

/// A processor whose one interrupt brings one byte, before the step of this number.
struct Chip {
    interrupt_at: Cell<Option<u32>>,
    step: Cell<u32>,
    is_pending: Cell<bool>,
    is_masked: Cell<bool>,
    bytes: Cell<u32>,
    /// It sleeps, and nothing will wake it.
    sleeps: Cell<bool>,
}

impl Chip {
    fn new(interrupt_at: u32) -> Self {
        Self {
            interrupt_at: Cell::new(Some(interrupt_at)),
            step: Cell::new(0),
            is_pending: Cell::new(false),
            is_masked: Cell::new(false),
            bytes: Cell::new(0),
            sleeps: Cell::new(false),
        }
    }

    /// Between two instructions.
    fn step(&self) {
        if self.interrupt_at.get() == Some(self.step.get()) {
            self.interrupt_at.set(None);
            self.is_pending.set(true);
        }
        self.step.set(self.step.get() + 1);
        self.serve();
    }

    fn serve(&self) {
        if self.is_pending.get() && !self.is_masked.get() {
            self.is_pending.set(false);
            self.bytes.set(self.bytes.get() + 1);
        }
    }

    fn has_byte(&self) -> bool {
        self.step();
        let has = self.bytes.get() > 0;
        self.step();
        has
    }
}

impl Processor for Chip {
    fn masked(&self, run: impl FnOnce()) {
        self.step();
        self.is_masked.set(true);
        self.step();
        run();
        self.step();
        self.is_masked.set(false);
        self.serve();
        self.step();
    }

    fn wait(&self) {
        self.step();
        // An interrupt still to come wakes it.
        if !self.is_pending.get() && self.interrupt_at.get().is_none() {
            self.sleeps.set(true);
        }
        self.interrupt_at.take().is_some().then(|| self.is_pending.set(true));
        self.serve();
    }
}

/// Steps that any of these takes.
const STEPS: u32 = 12;

#[test]
fn no_byte_is_slept_through() {
    for at in 0..STEPS {
        let chip = Chip::new(at);
        sleep_unless(&chip, || chip.has_byte());
        assert!(!chip.sleeps.get(), "asleep for ever after an interrupt at step {at}");
        assert_eq!(chip.bytes.get() + u32::from(chip.interrupt_at.get().is_some()), 1);
    }
}

/// The model itself, against a look before the mask, and one without: each sleeps through some.
#[test]
fn a_look_too_early_sleeps_through_some() {
    let sleeping = |fall_asleep: fn(&Chip)| {
        (0..STEPS)
            .filter(|at| {
                let chip = Chip::new(*at);
                fall_asleep(&chip);
                chip.sleeps.get()
            })
            .count()
    };
    let unmasked = sleeping(|chip| {
        if !chip.has_byte() {
            chip.wait();
        }
    });
    let early = sleeping(|chip| {
        if !chip.has_byte() {
            chip.masked(|| chip.wait());
        }
    });
    assert!(unmasked > 0 && early > 0, "{unmasked} and {early}");
}

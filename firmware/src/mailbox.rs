//! One value on its way from one context to another, where the newest wins: three slots, of which the
//! writer has one, the reader has one, and the third is exchanged.
//!
//! Neither end waits, whichever of them interrupts the other. That no value is torn and none comes
//! back is checked over all interleavings by `tests/mailbox.rs`.

use crate::cell::{AtomicU8, Ordering, UnsafeCell};

/// In [`Mailbox::middle`], above the slot's number: the reader has not seen it yet.
const FRESH: u8 = 4;

/// A value on its way.
pub struct Mailbox<T> {
    pub(crate) slots: [UnsafeCell<Option<T>>; 3],
    /// The slot that neither end has.
    pub(crate) middle: AtomicU8,
}

// SAFETY: a slot is reached by its number alone, and each number is in one place: at the writer, at the
// reader, or in `middle`, through which they pass by atomic exchanges.
unsafe impl<T: Send> Sync for Mailbox<T> {}

/// The end that puts values in.
pub struct Writer<'a, T> {
    mailbox: &'a Mailbox<T>,
    own: u8,
}

/// The end that takes them out.
pub struct Reader<'a, T> {
    mailbox: &'a Mailbox<T>,
    own: u8,
}

impl<T> Mailbox<T> {
    /// Its two ends.
    pub fn split(&mut self) -> (Writer<'_, T>, Reader<'_, T>) {
        let mailbox = &*self;
        let taken = mailbox.middle.load(Ordering::Relaxed) & !FRESH;
        let [writer, reader] = [(taken + 1) % 3, (taken + 2) % 3];
        (Writer { mailbox, own: writer }, Reader { mailbox, own: reader })
    }
}

impl<T> Writer<'_, T> {
    /// Puts a value in the place of whatever is there.
    ///
    /// # Returns
    /// Whether that had not been read.
    pub fn post(&mut self, value: T) -> bool {
        let slot = &self.mailbox.slots[usize::from(self.own).min(2)];
        // SAFETY: the writer's slot.
        slot.with_mut(|slot| unsafe { *slot = Some(value) });
        let before = self.mailbox.middle.swap(self.own | FRESH, Ordering::AcqRel);
        self.own = before & !FRESH;
        before & FRESH != 0
    }
}

impl<T> Reader<'_, T> {
    /// Gives `read` the newest value; nothing if it has seen that already.
    #[inline(always)]
    pub fn read<R>(&mut self, read: impl FnOnce(Option<&T>) -> R) -> R {
        let is_fresh = self.mailbox.middle.load(Ordering::Relaxed) & FRESH != 0;
        if is_fresh {
            self.own = self.mailbox.middle.swap(self.own, Ordering::AcqRel) & !FRESH;
        }
        // It is at most 2 anyway.
        let slot = &self.mailbox.slots[usize::from(self.own).min(2)];
        slot.with(|slot| {
            // SAFETY: the reader's slot.
            read(if is_fresh { unsafe { (*slot).as_ref() } } else { None })
        })
    }
}

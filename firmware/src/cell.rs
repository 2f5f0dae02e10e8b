//! What [`crate::mailbox`] is built on, in the form in which a model checker can replace it.

use crate::mailbox::Mailbox;

pub use core::sync::atomic::{AtomicU8, Ordering};

/// `core::cell::UnsafeCell`, with accesses that begin and end.
pub struct UnsafeCell<T>(core::cell::UnsafeCell<T>);

impl<T> UnsafeCell<T> {
    /// A cell that holds `value`.
    pub const fn new(value: T) -> Self {
        Self(core::cell::UnsafeCell::new(value))
    }

    /// Reads.
    #[inline(always)]
    pub fn with<R>(&self, read: impl FnOnce(*const T) -> R) -> R {
        read(self.0.get())
    }

    /// Writes.
    #[inline(always)]
    pub fn with_mut<R>(&self, write: impl FnOnce(*mut T) -> R) -> R {
        write(self.0.get())
    }
}

impl<T> Mailbox<T> {
    /// An empty one. It is made here because a model checker's cannot be constants.
    #[allow(clippy::new_without_default)]
    pub const fn new() -> Self {
        Self { slots: [const { UnsafeCell::new(None) }; 3], middle: AtomicU8::new(0) }
    }
}

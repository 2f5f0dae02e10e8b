//! All interleavings of a writer and a reader, by loom: the mailbox's own source, on loom's atomics and
//! cells, which also report any access that another one could disturb.

#[path = "../src/mailbox.rs"]
mod mailbox;

mod cell {
    use crate::mailbox::Mailbox;

    pub use loom::cell::UnsafeCell;
    pub use loom::sync::atomic::{AtomicU8, Ordering};

    impl<T> Mailbox<T> {
        pub fn new() -> Self {
            Self { slots: std::array::from_fn(|_| UnsafeCell::new(None)), middle: AtomicU8::new(0) }
        }
    }
}

use mailbox::Mailbox;

/// Values come out whole, in the order in which they went in, none twice; and the last one comes out.
#[test]
fn the_newest_value_arrives() {
    const LAST: u32 = 3;
    loom::model(|| {
        let mailbox: &'static mut Mailbox<[u32; 2]> = Box::leak(Box::new(Mailbox::new()));
        let (mut writer, mut reader) = mailbox.split();
        let writing = loom::thread::spawn(move || {
            // Which values had not been read when the next came.
            (1..=LAST).filter(|value| writer.post([*value, !*value])).count()
        });
        let mut seen = 0;
        let mut taken = 0;
        let mut take = |seen: &mut u32| {
            reader.read(|value| {
                if let Some([value, complement]) = value {
                    assert_eq!(*complement, !*value, "torn");
                    assert!(*value > *seen, "{value} after {seen}");
                    *seen = *value;
                    taken += 1;
                }
            });
        };
        take(&mut seen);
        take(&mut seen);
        let replaced = writing.join().expect("it ends");
        take(&mut seen);
        assert_eq!(seen, LAST, "the newest");
        take(&mut seen);
        assert_eq!(taken + replaced as u32, LAST, "each is read or replaced, and known to be");
    });
}

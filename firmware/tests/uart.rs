//! A UART as RM0090, section 30.3.3, describes it, and bytes that come at any time: the interrupt ends,
//! and every byte is received or counted.

use std::cell::{Cell, RefCell};
use std::collections::VecDeque;
use surefoot_firmware::uart::{Errors, Registers, receive};
use surefoot_link::LineErrors;

const PE: u32 = 1;
const FE: u32 = 2;
const NF: u32 = 4;
const ORE: u32 = 8;
const RXNE: u32 = 32;

/// The receiving half. Before each access of a register some bytes may come.
#[derive(Default)]
struct Uart {
    status: Cell<u32>,
    data: Cell<u8>,
    /// Flags that a read of the status has shown: the next read of the data clears them.
    shown: Cell<u32>,
    /// Bytes, with their flags, that come before each of the next accesses.
    coming: RefCell<VecDeque<Vec<(u8, u32)>>>,
    lost: Cell<u32>,
}

impl Uart {
    fn byte(&self, byte: u8, flags: u32) {
        // An overrun leaves the data register as it is, and stands in the way of all bytes.
        if self.status.get() & (RXNE | ORE) != 0 {
            self.status.set(self.status.get() | ORE);
            self.lost.set(self.lost.get() + 1);
        } else {
            self.data.set(byte);
            self.status.set(self.status.get() | RXNE | flags);
        }
    }

    fn pass_time(&self) {
        let bytes = self.coming.borrow_mut().pop_front().unwrap_or_default();
        bytes.into_iter().for_each(|(byte, flags)| self.byte(byte, flags));
    }

    fn interrupts(&self) -> bool {
        self.status.get() & (RXNE | ORE) != 0
    }
}

impl Registers for Uart {
    fn status(&self) -> u32 {
        self.pass_time();
        self.shown.set(self.status.get() & (PE | FE | NF | ORE));
        self.status.get()
    }

    fn data(&self) -> u32 {
        self.pass_time();
        self.status.set(self.status.get() & !RXNE & !self.shown.replace(0));
        u32::from(self.data.get())
    }
}

/// Up to two bytes before each of four accesses, with each set of flags.
#[test]
fn the_interrupt_ends_and_every_byte_is_received_or_counted() {
    let flags = [0, NF, FE, PE];
    let mut overruns = 0;
    for pattern in 0..3_u32.pow(4) {
        for flag in flags {
            let uart = Uart::default();
            let errors = Errors::new();
            uart.byte(b'a', flag);
            let mut sent = 1;
            for access in 0..4 {
                let count = pattern / 3_u32.pow(access) % 3;
                let bytes = (0..count).map(|i| (b'b' + (sent + i) as u8, 0)).collect();
                uart.coming.borrow_mut().push_back(bytes);
                sent += count;
            }
            let mut received = 0;
            let mut calls = 0;
            while uart.interrupts() {
                received += u32::from(receive(&uart, &errors).is_some());
                calls += 1;
                assert!(calls <= 6, "the interrupt stays: pattern {pattern}, flag {flag}");
            }
            let tally = errors.tally();
            let spoilt = tally.framing + tally.parity;
            let still_coming: usize = uart.coming.borrow().iter().map(Vec::len).sum();
            let arrived = sent - still_coming as u32;
            assert_eq!(received + spoilt + uart.lost.get(), arrived);
            assert_eq!(tally.overrun > 0, uart.lost.get() > 0, "an overrun is counted");
            assert!(tally.overrun <= uart.lost.get(), "and only where a byte was lost");
            let one = |of: u32| u32::from(flag == of);
            assert_eq!((tally.framing, tally.parity, tally.noise), (one(FE), one(PE), one(NF)));
            overruns += tally.overrun;
        }
    }
    assert!(overruns > 100, "{overruns}");
}

/// The model itself, against a handler that reads the data alone: its interrupt stays for ever.
#[test]
fn data_alone_does_not_end_an_overrun() {
    let uart = Uart::default();
    uart.byte(b'a', 0);
    uart.byte(b'b', 0);
    for _ in 0..100 {
        uart.data();
        assert!(uart.interrupts());
    }
}

#[test]
fn a_noisy_byte_is_left_to_the_checksum() {
    let (uart, errors) = (Uart::default(), Errors::new());
    uart.byte(b'a', NF);
    assert_eq!(receive(&uart, &errors), Some(b'a'));
    assert_eq!(errors.tally(), LineErrors { noise: 1, ..LineErrors::default() });
}

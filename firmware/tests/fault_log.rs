//! Power fails at every byte: what was logged before stands.

use surefoot::balance::{Mode, StopReason};
use surefoot_firmware::fault_log::{self, CONTENTS, Memory, SIZE};
use surefoot_link::{Crash, FaultLog, LoggedFault};

/// Memory that takes a number of bytes, and then no more.
#[derive(Clone)]
struct Failing {
    bytes: [u8; SIZE],
    left: usize,
}

impl Memory for Failing {
    fn read(&self, at: usize) -> u8 {
        self.bytes[at]
    }

    fn write(&mut self, at: usize, byte: u8) {
        if self.left > 0 {
            self.left -= 1;
            self.bytes[at] = byte;
        }
    }
}

fn contents(number: u8) -> [u8; CONTENTS] {
    std::array::from_fn(|i| (i as u8).wrapping_mul(31) ^ number.wrapping_mul(101))
}

/// Bytes of one write: the version twice.
const WRITTEN: usize = fault_log::SLOT + 1;

#[test]
fn power_fails_at_every_byte_of_every_write() {
    // Whatever memory without power leaves: zeros, ones, a pattern.
    for garbage in [0, 0xff, 0xa5, 2] {
        let mut memory = Failing { bytes: [garbage; SIZE], left: usize::MAX };
        assert_eq!(fault_log::read(&memory), None);
        let mut before = None;
        for number in 0..6 {
            for left in 0..=WRITTEN {
                let mut failing = Failing { left, ..memory.clone() };
                fault_log::write(&mut failing, &contents(number));
                let expected = if left == WRITTEN { Some(contents(number)) } else { before };
                assert_eq!(fault_log::read(&failing), expected, "{left} bytes of write {number}");
                // And the next write is not put out by the torn one.
                failing.left = usize::MAX;
                fault_log::write(&mut failing, &contents(99));
                assert_eq!(fault_log::read(&failing), Some(contents(99)));
            }
            fault_log::write(&mut memory, &contents(number));
            before = Some(contents(number));
        }
    }
}

/// The newest wins, also where the counter goes round.
#[test]
fn the_newest_of_many_wins() {
    let mut memory = Failing { bytes: [0; SIZE], left: usize::MAX };
    fault_log::write(&mut memory, &contents(0));
    // As the slot would be 2³² − 3 writes later.
    let (body, checksum) = memory.bytes[..fault_log::SLOT].split_last_chunk_mut().expect("long");
    body[1..5].copy_from_slice(&(u32::MAX - 2).to_le_bytes());
    *checksum = crc::Crc::<u32>::new(&crc::CRC_32_ISO_HDLC).checksum(body).to_le_bytes();
    assert_eq!(fault_log::read(&memory), Some(contents(0)));
    for number in 1..=9 {
        fault_log::write(&mut memory, &contents(number));
        assert_eq!(fault_log::read(&memory), Some(contents(number)));
    }
}

/// One flipped bit anywhere in the newest slot: the one before stands.
#[test]
fn a_flipped_bit_is_found() {
    let mut memory = Failing { bytes: [0; SIZE], left: usize::MAX };
    fault_log::write(&mut memory, &contents(1));
    fault_log::write(&mut memory, &contents(2));
    for bit in 0..8 * fault_log::SLOT {
        let mut spoilt = memory.clone();
        // The second write is in the second slot.
        spoilt.bytes[fault_log::SLOT + bit / 8] ^= 1 << (bit % 8);
        assert_eq!(fault_log::read(&spoilt), Some(contents(1)), "bit {bit}");
    }
}

#[test]
fn the_longest_log_fits() {
    let most = u32::MAX;
    let mut log = FaultLog {
        resets: most,
        mode_at_reset: Some(Mode::Stopping { left: u16::MAX }),
        crashes: most,
        crash: Some(Crash::HardFault { at: most, status: most }),
        ..FaultLog::default()
    };
    // Indices have 32 bits on the target.
    let reason = StopReason::Frozen { leg: most as usize, joint: most as usize };
    while log.stops.push(LoggedFault { reset: most, tick: most, reason }).is_ok() {}
    let mut bytes = [0; CONTENTS];
    let used = postcard::to_slice(&log, &mut bytes).expect("it fits").len();
    println!("{used} of {CONTENTS} bytes");
}

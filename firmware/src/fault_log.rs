//! A log in memory that outlives resets, of which power may fail at any byte: two slots, written in
//! turns.
//!
//! ```text
//! byte 0      1 to 4    5 to SLOT − 5    last 4
//! VERSION     counter   contents         CRC-32 of all before
//! ```
//! A slot is written from its second byte on while its first is 0, and that is set last. Until then
//! the other slot stands, whole.

use surefoot_link::checksum;

/// Bytes of the log's contents.
pub const CONTENTS: usize = SLOT - 1 - 4 - 4;

/// Bytes of a slot.
pub const SLOT: usize = 256;

/// Bytes of both.
pub const SIZE: usize = 2 * SLOT;

/// Form of the contents, which are one of the link's messages. A log of another version is no log.
const VERSION: u8 = surefoot_link::VERSION;

/// What stands in the place of the version while the slot is written.
const UNFINISHED: u8 = 0;

/// Bytes that keep what is written, one at a time and in that order.
pub trait Memory {
    /// One of [`SIZE`] bytes.
    fn read(&self, at: usize) -> u8;
    /// Writes it.
    fn write(&mut self, at: usize, byte: u8);
}

/// A slot that is whole.
struct Whole {
    number: usize,
    counter: u32,
    contents: [u8; CONTENTS],
}

/// The newest contents; nothing if neither slot is whole.
pub fn read(memory: &impl Memory) -> Option<[u8; CONTENTS]> {
    newest(memory).map(|slot| slot.contents)
}

/// Writes contents in the place of those before last.
pub fn write(memory: &mut impl Memory, contents: &[u8; CONTENTS]) {
    let newest = newest(memory);
    let slot = newest.as_ref().map_or(0, |newest| 1 - newest.number);
    let counter = newest.map_or(0, |newest| newest.counter.wrapping_add(1)).to_le_bytes();
    let mut bytes = [VERSION; SLOT];
    let Some((body, end)) = bytes.split_last_chunk_mut::<4>() else { return };
    body.iter_mut().skip(1).zip(counter.iter().chain(contents)).for_each(|(to, from)| *to = *from);
    *end = checksum(body).to_le_bytes();
    let first = slot * SLOT;
    memory.write(first, UNFINISHED);
    for (at, byte) in (first..).zip(bytes).skip(1) {
        memory.write(at, byte);
    }
    memory.write(first, VERSION);
}

/// A number that differs between lives of the memory: of what it holds, in order or not.
pub fn fingerprint(memory: &impl Memory) -> u32 {
    let [first, second] = [0, 1].map(|number| checksum(&slot(memory, number)));
    first ^ second.rotate_left(16)
}

fn newest(memory: &impl Memory) -> Option<Whole> {
    match (whole(memory, 0), whole(memory, 1)) {
        // Counters go round, and differ by one.
        (Some(first), Some(second)) if second.counter.wrapping_sub(first.counter) == 1 => {
            Some(second)
        }
        (first, second) => first.or(second),
    }
}

fn whole(memory: &impl Memory, number: usize) -> Option<Whole> {
    let bytes = slot(memory, number);
    let (body, end) = bytes.split_last_chunk::<4>()?;
    if checksum(body).to_le_bytes() != *end {
        return None;
    }
    let (version, body) = body.split_first()?;
    let (counter, contents) = body.split_first_chunk::<4>()?;
    let is_known = *version == VERSION;
    let contents = contents.try_into().ok().filter(|_| is_known)?;
    Some(Whole { number, counter: u32::from_le_bytes(*counter), contents })
}

fn slot(memory: &impl Memory, number: usize) -> [u8; SLOT] {
    core::array::from_fn(|i| memory.read(number * SLOT + i))
}

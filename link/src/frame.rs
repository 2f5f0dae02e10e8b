//! Frames: a message with its number, a checksum, and an end.

use serde::{Deserialize, Serialize};

/// Version of the messages. Both ends must have the same; it goes up when a message changes.
pub const VERSION: u8 = 2;

/// Largest frame, in bytes on the wire, its end included.
pub const FRAME: usize = 512;

/// CRC-32 of ISO 3309 (Ethernet, zlib): finds all errors of up to 3 bits in frames of this length.
pub(crate) const CHECKSUM: crc::Crc<u32> = crc::Crc::<u32>::new(&crc::CRC_32_ISO_HDLC);

/// Bytes of the checksum.
pub(crate) const CHECKSUM_BYTES: usize = 4;

/// What stands before a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Header {
    pub version: u8,
    pub sequence: u32,
}

/// The sending end: numbers frames as it makes them.
#[derive(Debug, Default)]
pub struct Sender {
    next: u32,
}

impl Sender {
    /// A sender that has said nothing. Its first frame has number 0, which tells the receiver to
    /// forget all numbers before.
    pub const fn new() -> Self {
        Self { next: 0 }
    }

    /// Writes a message as a frame into `wire` and gives the part of it that was written; `None`
    /// where the message is longer than a frame can be.
    pub fn encode<'a, M: Serialize>(
        &mut self,
        message: &M,
        wire: &'a mut [u8; FRAME],
    ) -> Option<&'a [u8]> {
        let mut plain = [0; FRAME];
        let header = Header { version: VERSION, sequence: self.next };
        let used = postcard::to_slice(&(header, message), &mut plain).ok()?.len();
        let checksum = CHECKSUM.checksum(plain.get(..used)?).to_le_bytes();
        plain.get_mut(used..used + CHECKSUM_BYTES)?.copy_from_slice(&checksum);
        let plain = plain.get(..used + CHECKSUM_BYTES)?;
        // The last byte is the end.
        let length = cobs::try_encode(plain, wire.get_mut(..FRAME - 1)?).ok()?;
        *wire.get_mut(length)? = 0;
        // After 2³² frames it goes on with 1: 0 is for a new beginning.
        self.next = self.next.checked_add(1).unwrap_or(1);
        wire.get(..=length)
    }
}

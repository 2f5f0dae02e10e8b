//! Frames: a message with its number, a checksum, and an end.

use crate::sequence::FrameNumber;
use serde::Serialize;

/// Version of the messages. Both ends must have the same; it goes up when a message changes.
pub const VERSION: u8 = 5;

/// Largest frame of robots with so many joints, in bytes on the wire, its end included: their settings,
/// or the status, which is that of all robots.
pub const fn frame_bytes(joints: usize) -> usize {
    const STATUS: usize = 512;
    // Header, variant, checksum, end: 16; period, pacing, gains, big base: 58; thresholds: 56; number of
    // joints: 2.
    let plain = 132 + 16 * joints;
    let settings = plain + plain.div_ceil(254);
    if settings > STATUS { settings } else { STATUS }
}

/// The same for every robot that a byte can count the joints of.
pub const MOST_FRAME: usize = frame_bytes(u8::MAX as usize);

/// CRC-32 of ISO 3309 (Ethernet, zlib): finds all errors of up to 3 bits in frames of this length.
const CHECKSUM: crc::Crc<u32> = crc::Crc::<u32>::new(&crc::CRC_32_ISO_HDLC);

/// A frame's checksum, for whatever else needs one.
#[inline(never)]
pub fn checksum(bytes: &[u8]) -> u32 {
    CHECKSUM.checksum(bytes)
}

/// Bytes of the checksum.
pub(crate) const CHECKSUM_BYTES: usize = 4;

/// Most bytes before a message: version, session, and a number of variable length.
const MOST_HEADER_BYTES: usize = 1 + 4 + 5;

/// What stands before a message. The version is a byte of its own in every version.
pub(crate) type Header = (u8, [u8; 4], u32);

/// The sending end: numbers frames as it makes them.
#[derive(Debug)]
pub struct Sender {
    next: FrameNumber,
}

impl Sender {
    /// A sender that has said nothing. Its `session` tells it from those before: a number that the
    /// receiver has not heard lately, such as a random one.
    pub const fn new(session: u32) -> Self {
        Self { next: FrameNumber { session, sequence: 0 } }
    }

    /// Writes a message as a frame into `wire` and gives the part of it that was written; `None`
    /// where the message is longer than a frame can be.
    pub fn encode<'a, M: Serialize, const FRAME: usize>(
        &mut self,
        message: &M,
        wire: &'a mut [u8; FRAME],
    ) -> Option<&'a [u8]> {
        let mut plain = [0; FRAME];
        let header: Header = (VERSION, self.next.session.to_le_bytes(), self.next.sequence);
        let used = postcard::to_slice(&(header, message), &mut plain).ok()?.len();
        let checksum = checksum(plain.get(..used)?).to_le_bytes();
        plain.get_mut(used..used + CHECKSUM_BYTES)?.copy_from_slice(&checksum);
        let plain = plain.get(..used + CHECKSUM_BYTES)?;
        // The last byte is the end.
        let length = cobs::try_encode(plain, wire.get_mut(..FRAME - 1)?).ok()?;
        *wire.get_mut(length)? = 0;
        self.next.sequence = self.next.sequence.wrapping_add(1);
        wire.get(..=length)
    }
}

/// Most bytes that a message takes on the wire, whatever its frame's number; `None` where it cannot be
/// written.
pub fn most_wire_bytes<M: Serialize>(message: &M) -> Option<usize> {
    let plain =
        MOST_HEADER_BYTES + postcard::experimental::serialized_size(message).ok()? + CHECKSUM_BYTES;
    Some(cobs::max_encoding_length(plain) + 1)
}

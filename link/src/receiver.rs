//! The receiving end: bytes in, messages or reasons out.

use crate::frame::{CHECKSUM_BYTES, VERSION, checksum};
use crate::sequence::{FrameNumber, SequenceWindow};
use core::marker::PhantomData;
use heapless::Vec;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

/// Why a frame was rejected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rejected {
    /// Too short for any message, or cut off in the middle.
    Truncated,
    /// Longer than any message.
    TooLong,
    /// Its checksum is wrong.
    Corrupted,
    /// The other end speaks another version.
    Version(u8),
    /// Its number is that of the last frame, or one before.
    OutOfOrder,
    /// The first of another session: its sender has begun anew, and its next frame will be accepted.
    Session,
    /// Arrived whole, but is no message.
    Malformed,
}

/// What has arrived so far, by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Tally {
    /// Messages.
    pub accepted: u32,
    /// Numbers that were left out between two messages.
    pub lost: u32,
    /// See [`Rejected::Truncated`].
    pub truncated: u32,
    /// See [`Rejected::TooLong`].
    pub too_long: u32,
    /// See [`Rejected::Corrupted`].
    pub corrupted: u32,
    /// See [`Rejected::Version`].
    pub version: u32,
    /// See [`Rejected::OutOfOrder`].
    pub out_of_order: u32,
    /// See [`Rejected::Session`].
    pub session: u32,
    /// See [`Rejected::Malformed`].
    pub malformed: u32,
}

/// Puts frames of up to `FRAME` bytes together again and takes messages `M` out of them.
#[derive(Debug)]
pub struct Receiver<M, const FRAME: usize> {
    bytes: Vec<u8, FRAME>,
    /// The present frame is longer than a frame can be.
    is_too_long: bool,
    window: SequenceWindow,
    tally: Tally,
    message: PhantomData<M>,
}

impl<M: DeserializeOwned, const FRAME: usize> Receiver<M, FRAME> {
    /// A receiver that has heard nothing.
    pub const fn new() -> Self {
        Self {
            bytes: Vec::new(),
            is_too_long: false,
            window: SequenceWindow::new(),
            tally: Tally {
                accepted: 0,
                lost: 0,
                truncated: 0,
                too_long: 0,
                corrupted: 0,
                version: 0,
                out_of_order: 0,
                session: 0,
                malformed: 0,
            },
            message: PhantomData,
        }
    }

    /// Takes one byte. At the end of a frame: its message, or why there is none.
    pub fn take(&mut self, byte: u8) -> Option<Result<M, Rejected>> {
        if byte != 0 {
            self.is_too_long |= self.bytes.push(byte).is_err();
            return None;
        }
        let result = if self.is_too_long { Err(Rejected::TooLong) } else { self.decode() };
        self.bytes.clear();
        self.is_too_long = false;
        let count = match &result {
            Ok(_) => &mut self.tally.accepted,
            Err(Rejected::Truncated) => &mut self.tally.truncated,
            Err(Rejected::TooLong) => &mut self.tally.too_long,
            Err(Rejected::Corrupted) => &mut self.tally.corrupted,
            Err(Rejected::Version(_)) => &mut self.tally.version,
            Err(Rejected::OutOfOrder) => &mut self.tally.out_of_order,
            Err(Rejected::Session) => &mut self.tally.session,
            Err(Rejected::Malformed) => &mut self.tally.malformed,
        };
        *count = count.saturating_add(1);
        Some(result)
    }

    /// Counts so far.
    pub fn tally(&self) -> Tally {
        self.tally
    }

    /// Session of the sender, as of the last frame that was not rejected.
    pub fn session(&self) -> Option<u32> {
        self.window.session()
    }

    /// Apart, so that what becomes of the message has not the stack of all kinds of them.
    #[inline(never)]
    fn decode(&mut self) -> Result<M, Rejected> {
        let length = cobs::decode_in_place(&mut self.bytes).map_err(|_| Rejected::Truncated)?;
        let frame = self.bytes.get(..length).ok_or(Rejected::Truncated)?;
        let (plain, sum) = frame.split_last_chunk::<CHECKSUM_BYTES>().ok_or(Rejected::Truncated)?;
        if checksum(plain) != u32::from_le_bytes(*sum) {
            return Err(Rejected::Corrupted);
        }
        let (version, plain) = plain.split_first().ok_or(Rejected::Malformed)?;
        if *version != VERSION {
            return Err(Rejected::Version(*version));
        }
        let ((session, sequence), rest) =
            postcard::take_from_bytes::<([u8; 4], u32)>(plain).map_err(|_| Rejected::Malformed)?;
        let session = u32::from_le_bytes(session);
        let lost = self.window.accept(FrameNumber { session, sequence })?;
        let (message, rest) =
            postcard::take_from_bytes::<M>(rest).map_err(|_| Rejected::Malformed)?;
        if !rest.is_empty() {
            return Err(Rejected::Malformed);
        }
        self.tally.lost = self.tally.lost.saturating_add(lost);
        Ok(message)
    }
}

impl<M: DeserializeOwned, const FRAME: usize> Default for Receiver<M, FRAME> {
    fn default() -> Self {
        Self::new()
    }
}

impl core::fmt::Display for Rejected {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Truncated => f.write_str("a frame was cut short"),
            Self::TooLong => f.write_str("a frame was longer than any message"),
            Self::Corrupted => f.write_str("a frame's checksum was wrong"),
            Self::Version(theirs) => {
                write!(f, "the other end speaks version {theirs} of the link, this one {VERSION}")
            }
            Self::OutOfOrder => f.write_str("a frame came twice or out of order"),
            Self::Session => f.write_str("the other end has begun anew"),
            Self::Malformed => f.write_str("a frame held no message"),
        }
    }
}

impl core::error::Error for Rejected {}

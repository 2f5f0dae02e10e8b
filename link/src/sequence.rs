//! Which frames are new: numbers within a session, and sessions that take over.

use crate::Rejected;

/// What tells one frame from all others: its sender's session, and its number in that.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct FrameNumber {
    pub session: u32,
    pub sequence: u32,
}

/// Tells new frames from repeated, old and foreign ones.
///
/// - Within a session the numbers of accepted frames only grow, so that none is accepted twice or
///   after a later one.
/// - A sender that has begun anew has another session. It takes over with the second of its frames in
///   a row, whatever their numbers: a restart costs one frame, and one stray frame of a session that is
///   over changes nothing.
#[derive(Debug)]
pub(crate) struct SequenceWindow {
    /// Last accepted.
    last: Option<FrameNumber>,
    /// Last of another session, since `last` was accepted.
    foreign: Option<FrameNumber>,
}

impl SequenceWindow {
    /// The first frame will be accepted.
    pub const fn new() -> Self {
        Self { last: None, foreign: None }
    }

    /// Session of the last accepted frame.
    pub fn session(&self) -> Option<u32> {
        self.last.map(|last| last.session)
    }

    /// Accepts a frame, or says why not.
    ///
    /// # Returns
    /// How many numbers were left out before it.
    pub fn accept(&mut self, frame: FrameNumber) -> Result<u32, Rejected> {
        let lost = match self.last {
            None => 0,
            Some(last) if last.session == frame.session => {
                frame.ahead_of(last).ok_or(Rejected::OutOfOrder)? - 1
            }
            Some(_) => match self.foreign.filter(|first| first.session == frame.session) {
                None => {
                    self.foreign = Some(frame);
                    return Err(Rejected::Session);
                }
                Some(first) => frame.ahead_of(first).ok_or(Rejected::OutOfOrder)? - 1,
            },
        };
        *self = Self { last: Some(frame), foreign: None };
        Ok(lost)
    }
}

impl FrameNumber {
    /// By how much its number is later, where it is: numbers go round after 2³².
    fn ahead_of(self, other: Self) -> Option<u32> {
        let ahead = self.sequence.wrapping_sub(other.sequence);
        (ahead != 0 && ahead <= u32::MAX / 2).then_some(ahead)
    }
}

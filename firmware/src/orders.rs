//! What idle may answer while orders are on their way to the tick.

use surefoot::balance::Mode;

/// Orders on their way, and the mode after those that were taken.
///
/// Only an order to arm leads out of standby. So as long as none is on its way, a robot that was in
/// standby after the last order that it took is in standby when it takes the next.
pub struct Orders {
    sent: u32,
    /// As of the last record.
    mode: Mode,
    /// Number of the last order to arm, until it is known to have been taken.
    arming: Option<u32>,
}

impl Orders {
    /// None sent, in standby.
    pub const fn new() -> Self {
        Self { sent: 0, mode: Mode::Standby, arming: None }
    }

    /// An order is in the queue, whether or not the tick has taken it yet.
    pub fn note_sent(&mut self, is_arm: bool) {
        self.sent = self.sent.wrapping_add(1);
        if is_arm {
            self.arming = Some(self.sent);
        }
    }

    /// What a tick has reported: orders that it had taken, and the mode after it.
    pub fn note_tick(&mut self, taken: u32, mode: Mode) {
        self.mode = mode;
        // Numbers go round.
        let is_taken = |arming: &u32| taken.wrapping_sub(*arming) <= u32::MAX / 2;
        self.arming = self.arming.filter(|arming| !is_taken(arming));
    }

    /// As of the last record.
    pub fn mode(&self) -> Mode {
        self.mode
    }

    /// Whether the next order will find the tick in standby, for certain.
    pub fn is_standby(&self) -> bool {
        self.mode == Mode::Standby && self.arming.is_none()
    }
}

impl Default for Orders {
    fn default() -> Self {
        Self::new()
    }
}

//! Bytes to and from a target.

use super::LinkError;
use std::time::Duration;

/// A way for bytes.
pub trait Transport {
    /// Sends all bytes.
    ///
    /// # Errors
    /// If they cannot be sent.
    fn send(&mut self, bytes: &[u8]) -> Result<(), LinkError>;

    /// What has arrived; waits for it, but not longer than `patience`.
    ///
    /// # Errors
    /// [`LinkError::Silent`] if nothing came, or what became of the other end.
    fn receive(&mut self, patience: Duration) -> Result<Vec<u8>, LinkError>;
}

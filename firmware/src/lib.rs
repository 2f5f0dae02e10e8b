//! What of the firmware can be reasoned about without a chip, and is tested without one.

#![no_std]

pub mod cell;
pub mod clock;
pub mod fault_log;
pub mod freshness;
pub mod mailbox;
pub mod orders;
pub mod sleep;
pub mod uart;
pub mod watchdog;

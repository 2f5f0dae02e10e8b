//! The firmware in the loop: in an emulator that is started and stopped here, or on a board at a
//! serial port. The plant neither knows nor cares.
//!
//! ```text
//! FirmwareController ─► Target (orders, ticks) ─► Transport (bytes): Emulator's pipes, SerialPort
//! ```

mod controller;
mod emulator;
mod serial;
mod target;
mod transport;

pub use controller::{FirmwareController, set_point, settings};
pub use emulator::Emulator;
pub use serial::SerialPort;
pub use target::{LinkError, Target};
pub use transport::Transport;

//! The firmware in the loop: in an emulator that is started and stopped here, or on a board at a
//! serial port. The plant neither knows nor cares.
//!
//! ```text
//! FirmwareController ─► Target (orders, ticks) ─► Transport (bytes): Emulator's pipes, SerialPort
//! ```

mod controller;
mod emulator;
mod image;
mod robot_module;
mod serial;
mod target;
mod transport;

pub use controller::{
    FirmwareController, firmware_controller, sensors, set_point, settings, wrench_settings,
};
pub use emulator::Emulator;
pub use image::image_for;
pub use robot_module::{robot_module, whole_body_module};
pub use serial::SerialPort;
pub use target::{LinkError, Target};
pub use transport::Transport;

use controller::gains;
use image::folder_name;

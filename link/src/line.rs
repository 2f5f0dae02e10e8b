//! What the serial line carries in a period.

use crate::frame::most_wire_bytes;
use crate::limits::MOST_FEET;
use crate::{Joints, Sensors, ToTarget};

/// Bits a second, of both ends. USB adapters that do it are common (FT232R, FT232H, CP2102N, CH343).
///
/// An STM32F4's UART at 84 MHz divides exactly to it, by 28; to 2 000 000 by 42. At 921 600 the
/// shortest period would be 2.31 ms.
pub const BAUD: u32 = 3_000_000;

/// Start bit, eight bits of data, stop bit.
const BITS_A_BYTE: u32 = 10;

/// Share of the line that measurements may take; the rest is for orders between them.
const SHARE: (u32, u32) = (4, 5);

/// Time that the bytes of a frame take on the line, µs, rounded up; rates are hundreds of bits.
pub const fn wire_us(bytes: u32, baud: u32) -> u32 {
    (bytes * BITS_A_BYTE * 10_000).div_ceil(baud / 100)
}

/// Shortest period, µs, in which the line can carry one measurement of so many joints and forces a tick. Torques go
/// the other way, and fit into the period with an estimate too.
///
/// A measurement of twelve joints and no force takes 174 bytes at most: 580 µs at 3 Mbaud, so 725 µs.
pub fn shortest_period_us<const JOINTS: usize>(baud: u32, forces: usize) -> u32 {
    let longest =
        ToTarget::Sensors { taken_us: u32::MAX, sensors: Sensors::<JOINTS>::zero(forces) };
    let Some(bytes) = most_wire_bytes(&longest) else { return u32::MAX };
    (wire_us(bytes as u32, baud) * SHARE.1).div_ceil(SHARE.0)
}

impl<const JOINTS: usize> Sensors<JOINTS> {
    /// All numbers zero. Numbers take the same bytes whatever their value.
    fn zero(forces: usize) -> Self {
        Self {
            position: [0.0; 3],
            orientation: [0.0; 4],
            velocity: [0.0; 6],
            joint_angles: [0.0; JOINTS].into(),
            joint_rates: [0.0; JOINTS].into(),
            contacts: 0,
            forces: Joints::new([0.0; MOST_FEET], forces),
        }
    }
}

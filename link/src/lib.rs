//! What host and target say to each other, and how it is framed: the same code on both sides.
//!
//! ```text
//! message ─ postcard ─► version, session, sequence number, message ─ CRC-32 ─ COBS ─ 0 ─► bytes on the wire
//! ```
//! A zero byte ends a frame and occurs nowhere else, so that a receiver that has lost its place finds
//! it again at the next frame. A frame that is truncated, corrupted, repeated, out of order, of
//! another version or too long is rejected, and counted by its kind. A sender that has begun anew is
//! known by its session, and believed from its second frame on.
//!
//! Messages are those of a robot with so many joints. A target says at once which robot it has been built
//! for ([`RobotId`]), so that a host of another one knows; and it arms for no other.
//!
//! The link does not know what is at its other end: a plant of this project, another simulator, or a
//! test bench; a UART, a pipe or a socket.

#![no_std]
#![forbid(unsafe_code)]

mod frame;
mod joints;
mod limits;
mod line;
mod message;
mod receiver;
mod robot;
mod sensing;
mod sequence;
mod status;
mod walking;

pub use frame::{MOST_FRAME, Sender, VERSION, checksum, frame_bytes, most_wire_bytes};
pub use joints::Joints;
pub use limits::{MOST_FEET, StanceSettings, TickLimits, WrenchSettings};
pub use line::{BAUD, shortest_period_us, wire_us};
pub use message::{
    Acknowledged, Counter, FromTarget, Identity, Injection, Pacing, Sensors, SetPoint, Settings,
    Stages, ToTarget, Torques, by_joint, by_leg,
};
pub use receiver::{Receiver, Rejected, Tally};
pub use robot::RobotId;
pub use sensing::{Estimated, FilterSettings, ObserverSettings, Readings, by_foot};
pub use status::{Clock, Crash, FaultLog, LineErrors, LoggedFault, NoCrystal, Status};
pub use walking::{WalkOrder, WalkerFoot, WalkerSettings};

/// The package's own page.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

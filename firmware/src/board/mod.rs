//! The board: everything that another one would do differently.
//!
//! To change board, write a file like `stm32f405.rs` for its chip, put its device crate into
//! `Cargo.toml` and its memory into `memory.x`, and name its timer's and UART's interrupts where
//! `main.rs` says `binds`.

mod stm32f405;

#[cfg(feature = "emulation")]
mod emulation;
#[cfg(not(feature = "emulation"))]
mod hardware;

#[cfg(feature = "emulation")]
pub use emulation::{Counter, Link, TickTimer, due, exit, log};
#[cfg(not(feature = "emulation"))]
pub use hardware::{Counter, Link, TickTimer, log};
pub use stm32f405::{Board, ByteQueue, Motors, UartReceiver, Watchdog, device, restart, tick_now};

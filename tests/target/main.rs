//! The firmware in QEMU: same bits as the host, bounded time, and a safe state for every fault.
//!
//! `cargo xtask test` builds the images and runs this; by hand: `cargo xtask firmware`, then
//! `cargo test -p surefoot-tests --features target --test target`.

mod bench;
mod equality;
mod faults;
mod logging;
mod serial;
mod timing;

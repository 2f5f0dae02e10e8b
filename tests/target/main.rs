//! The firmware in QEMU: same bits as the host, bounded time, and a safe state for every fault.
//!
//! `cargo xtask test` builds the images and runs this; by hand: `cargo xtask firmware`, then
//! `cargo test --workspace --test target -- --ignored`.

mod bench;
mod chips;
mod equality;
mod faults;
mod logging;
mod serial;
mod timing;

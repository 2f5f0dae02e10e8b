//! Arm's MPS2 with the FPGA image AN500, a Cortex-M7 with a unit for double precision, as QEMU has it.
//!
//! The tick is in single precision here too. The image is compiled for the core itself (`-C target-cpu=cortex-m7`),
//! so that what there is of double precision takes its instructions.

/// Of an instruction, with `-icount shift=7`.
pub const NANOSECONDS: u64 = 128;
/// SysTick: the core's clock.
pub const SYSTICK_HZ: u64 = 25_000_000;
/// UART 0.
pub const UART_0: usize = 0x4000_4000;
/// The FPGA's I/O block.
pub const FPGA_IO: usize = 0x4002_8000;

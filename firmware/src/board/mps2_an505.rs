//! Arm's MPS2 with the FPGA image AN505, a Cortex-M33, as QEMU has it. All code is secure: addresses are those with
//! bit 28 set (application note AN505, section 3.1).

/// Of an instruction, with `-icount shift=7`.
pub const NANOSECONDS: u64 = 128;
/// SysTick: the core's clock.
pub const SYSTICK_HZ: u64 = 20_000_000;
/// UART 0.
pub const UART_0: usize = 0x5020_0000;
/// The FPGA's I/O block.
pub const FPGA_IO: usize = 0x5030_2000;

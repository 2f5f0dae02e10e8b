//! Memory that is not cleared at reset: the fault log, the last crash, and the painted stack.

use core::mem::MaybeUninit;
use core::ptr::{addr_of, addr_of_mut};
use surefoot_firmware::fault_log::{self, CONTENTS, Memory, SIZE};
use surefoot_link::{Crash, FaultLog, checksum};

/// Bytes of a crash: its longest form, and a checksum.
const CRASH: usize = 20;

/// Memory that startup code leaves alone.
#[unsafe(link_section = ".uninit.fault_log")]
static mut KEPT: MaybeUninit<[u8; SIZE + CRASH]> = MaybeUninit::uninit();

/// The log's part of it. Idle alone uses that.
struct Kept;

impl Memory for Kept {
    fn read(&self, at: usize) -> u8 {
        read_byte(at)
    }

    fn write(&mut self, at: usize, byte: u8) {
        write_byte(at, byte);
    }
}

/// The log, if the memory has kept it; an empty one otherwise.
pub fn read() -> FaultLog {
    let contents = fault_log::read(&Kept);
    contents.and_then(|contents| postcard::from_bytes(&contents).ok()).unwrap_or_default()
}

/// Keeps the log.
pub fn write(log: &FaultLog) {
    let mut contents = [0; CONTENTS];
    // A test makes sure that the longest fits.
    if postcard::to_slice(log, &mut contents).is_ok() {
        fault_log::write(&mut Kept, &contents);
    }
}

/// A number that differs from the last reset's: memory without power holds noise, and with it the log
/// has been written since.
pub fn fingerprint() -> u32 {
    fault_log::fingerprint(&Kept)
}

/// Keeps what the program ends of.
pub fn write_crash(crash: &Crash) {
    let mut bytes = [0; CRASH];
    let Some((body, end)) = bytes.split_last_chunk_mut::<4>() else { return };
    if postcard::to_slice(crash, body).is_ok() {
        *end = checksum(body).to_le_bytes();
        (SIZE..).zip(bytes).for_each(|(at, byte)| write_byte(at, byte));
    }
}

/// What the program has ended of before this reset.
pub fn read_crash() -> Option<Crash> {
    let bytes: [u8; CRASH] = core::array::from_fn(|i| read_byte(SIZE + i));
    let (body, end) = bytes.split_last_chunk::<4>()?;
    if checksum(body).to_le_bytes() == *end { postcard::from_bytes(body).ok() } else { None }
}

/// It is in the log now.
pub fn forget_crash() {
    (SIZE..SIZE + CRASH).for_each(|at| write_byte(at, 0xff));
}

/// Loses everything, as memory without power does.
#[cfg(feature = "emulation")]
pub fn forget() {
    (0..SIZE + CRASH).for_each(|at| write_byte(at, 0xa5));
}

fn read_byte(at: usize) -> u8 {
    if at >= SIZE + CRASH {
        return 0;
    }
    // SAFETY: inside KEPT; volatile, as its contents come from before this program began. Any byte is
    // a u8.
    unsafe { addr_of!(KEPT).cast::<u8>().add(at).read_volatile() }
}

fn write_byte(at: usize, byte: u8) {
    if at < SIZE + CRASH {
        // SAFETY: as above. Idle writes the log, and a crash, which nothing outlasts, its own part.
        unsafe { addr_of_mut!(KEPT).cast::<u8>().add(at).write_volatile(byte) };
    }
}

/// cortex-m-rt's `STACK_PAINT_VALUE`.
const PAINT: u32 = 0xcccc_cccc;

/// The stack's lowest and highest address.
fn stack() -> (*mut u32, *mut u32) {
    unsafe extern "C" {
        #[cfg_attr(target_arch = "riscv32", link_name = "__estack")]
        static mut _stack_end: u32;
        static mut _stack_start: u32;
    }
    (addr_of_mut!(_stack_end), addr_of_mut!(_stack_start))
}

/// Paints what is free of the stack, where startup code does not.
#[cfg(target_arch = "riscv32")]
pub fn paint_stack() {
    let (mut at, _) = stack();
    let pointer: usize;
    // SAFETY: reads a register.
    unsafe { core::arch::asm!("mv {}, sp", out(reg) pointer) };
    // Words below the stack pointer, but for those that this function may yet use.
    while (at as usize) + 256 < pointer {
        // SAFETY: within the stack's memory, and below all that is on it.
        unsafe { at.write_volatile(PAINT) };
        at = at.wrapping_add(1);
    }
}

/// Deepest the stack has been since the reset, in bytes: it has been painted before.
pub fn stack_bytes() -> u32 {
    let (low, high) = stack();
    let mut at = low.cast_const();
    // SAFETY: words of the stack's memory, from its lowest up; read only.
    while at < high && unsafe { at.read_volatile() } == PAINT {
        at = at.wrapping_add(1);
    }
    (high as usize - at as usize) as u32
}

//! Memory that is not cleared at reset: the fault log, and the painted stack.

use core::mem::MaybeUninit;
use core::ptr::{addr_of, addr_of_mut};
use surefoot_link::FaultLog;

/// Bytes kept for the log: its longest form, and a checksum.
const SIZE: usize = 256;

const CHECKSUM: crc::Crc<u32> = crc::Crc::<u32>::new(&crc::CRC_32_ISO_HDLC);

/// Startup code leaves this section alone.
#[unsafe(link_section = ".uninit.fault_log")]
static mut LOG: MaybeUninit<[u8; SIZE]> = MaybeUninit::uninit();

/// The log, if the memory has kept it; an empty one otherwise.
pub fn read() -> FaultLog {
    let mut bytes = [0_u8; SIZE];
    for (i, byte) in bytes.iter_mut().enumerate() {
        // SAFETY: inside LOG; only idle reads and writes it; volatile, as its contents come from
        // before this program began. Any byte is a u8.
        *byte = unsafe { addr_of!(LOG).cast::<u8>().add(i).read_volatile() };
    }
    let log = bytes.split_last_chunk::<4>().and_then(|(log, checksum)| {
        let is_whole = CHECKSUM.checksum(log) == u32::from_le_bytes(*checksum);
        if is_whole { postcard::from_bytes(log).ok() } else { None }
    });
    log.unwrap_or_default()
}

/// Keeps the log.
pub fn write(log: &FaultLog) {
    let mut bytes = [0_u8; SIZE];
    let Some((body, checksum)) = bytes.split_last_chunk_mut::<4>() else { return };
    if postcard::to_slice(log, body).is_err() {
        return;
    }
    *checksum = CHECKSUM.checksum(body).to_le_bytes();
    for (i, byte) in bytes.iter().enumerate() {
        // SAFETY: as above.
        unsafe { addr_of_mut!(LOG).cast::<u8>().add(i).write_volatile(*byte) };
    }
}

/// Loses the log, as memory without power does.
#[cfg(feature = "emulation")]
pub fn forget() {
    for i in 0..SIZE {
        // SAFETY: as above.
        unsafe { addr_of_mut!(LOG).cast::<u8>().add(i).write_volatile(0xa5) };
    }
}

/// Deepest the stack has been since the reset, in bytes: startup code has painted it.
pub fn stack_bytes() -> u32 {
    unsafe extern "C" {
        static mut _stack_end: u32;
        static mut _stack_start: u32;
    }
    /// cortex-m-rt's `STACK_PAINT_VALUE`.
    const PAINT: u32 = 0xcccc_cccc;
    let (low, high) = (addr_of!(_stack_end), addr_of!(_stack_start));
    let mut at = low;
    // SAFETY: words of the stack's memory, from its lowest up; read only.
    while at < high && unsafe { at.read_volatile() } == PAINT {
        at = at.wrapping_add(1);
    }
    (high as usize - at as usize) as u32
}

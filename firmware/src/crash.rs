//! What the program can end of: motors off, a note in memory that outlives the reset, and the reset.
//!
//! Memory, bus and usage faults have no handlers of their own, so that they become hard faults, whose
//! status names them. Everything else that nothing handles, NMI among it, ends in the default handler.

use crate::{board, no_init};
use cortex_m_rt::{ExceptionFrame, exception};
use surefoot_link::Crash;

/// Reaches the safe state, notes why, and resets. After that nothing moves until the host arms it.
fn end(crash: Crash) -> ! {
    // Before the motors: a tick would turn them on again.
    cortex_m::interrupt::disable();
    board::motors_off();
    no_init::write_crash(&crash);
    board::restart()
}

#[panic_handler]
fn on_panic(panic: &core::panic::PanicInfo<'_>) -> ! {
    let line = panic.location().map_or(0, core::panic::Location::line);
    end(Crash::Panic { line })
}

// SAFETY: it returns nowhere, and reads the frame alone.
#[exception]
unsafe fn HardFault(frame: &ExceptionFrame) -> ! {
    // SAFETY: a read without effect.
    let status = unsafe { (*cortex_m::peripheral::SCB::PTR).cfsr.read() };
    end(Crash::HardFault { at: frame.pc(), status })
}

// SAFETY: it returns nowhere.
#[exception]
unsafe fn DefaultHandler(number: i16) -> ! {
    end(Crash::Unhandled { number })
}

/// Ends the program as asked.
#[cfg(feature = "emulation")]
pub fn crash(crash: Crash) -> ! {
    match crash {
        Crash::Panic { .. } => panic!(),
        Crash::HardFault { .. } => cortex_m::asm::udf(),
        Crash::Unhandled { .. } => {
            // SAFETY: an interrupt that nothing else uses.
            unsafe { cortex_m::peripheral::NVIC::unmask(board::device::Interrupt::CAN1_TX) };
            rtic::pend(board::device::Interrupt::CAN1_TX);
            cortex_m::asm::isb();
            unreachable!()
        }
    }
}

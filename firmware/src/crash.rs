//! What the program can end of: motors off, a note in memory that outlives the reset, and the reset.
//!
//! Memory, bus and usage faults have no handlers of their own, so that they become hard faults, whose
//! status names them. Everything else that nothing handles, NMI among it, ends in the default handler.

use crate::{board, no_init};
use surefoot_link::Crash;

/// Reaches the safe state, notes why, and resets. After that nothing moves until the host arms it.
fn end(crash: Crash) -> ! {
    // Before the motors: a tick would turn them on again.
    mask_interrupts();
    board::motors_off();
    no_init::write_crash(&crash);
    board::restart()
}

#[panic_handler]
fn on_panic(panic: &core::panic::PanicInfo<'_>) -> ! {
    let line = panic.location().map_or(0, core::panic::Location::line);
    end(Crash::Panic { line })
}

#[cfg(target_arch = "arm")]
use cortex_m::interrupt::disable as mask_interrupts;
#[cfg(target_arch = "riscv32")]
use riscv::interrupt::disable as mask_interrupts;

#[cfg(target_arch = "arm")]
mod handlers {
    use super::end;
    use cortex_m_rt::{ExceptionFrame, exception};
    use surefoot_link::Crash;

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
}

/// The core's exceptions are its hard faults, with `mcause` as their status.
#[cfg(target_arch = "riscv32")]
mod handlers {
    use super::end;
    use riscv::register::{mcause, mepc};
    use surefoot_link::Crash;

    #[unsafe(export_name = "ExceptionHandler")]
    extern "C" fn exception(_: &riscv_rt::TrapFrame) -> ! {
        end(Crash::HardFault { at: mepc::read() as u32, status: mcause::read().bits() as u32 })
    }

    #[unsafe(export_name = "DefaultHandler")]
    extern "C" fn interrupt() -> ! {
        end(Crash::Unhandled { number: mcause::read().code() as i16 })
    }
}

/// Ends the program as asked.
#[cfg(feature = "emulation")]
pub fn crash(crash: Crash) -> ! {
    match crash {
        Crash::Panic { .. } => panic!(),
        Crash::HardFault { .. } => fault(),
        Crash::Unhandled { .. } => {
            pend_unhandled();
            unreachable!()
        }
    }
}

#[cfg(all(feature = "emulation", target_arch = "arm"))]
use cortex_m::asm::udf as fault;

#[cfg(all(feature = "emulation", target_arch = "riscv32"))]
fn fault() -> ! {
    // SAFETY: an instruction that does not exist.
    unsafe { core::arch::asm!("unimp", options(noreturn)) }
}

/// An interrupt that nothing else uses: number 19 of the chip's, CAN1_TX on the reference board.
#[cfg(all(feature = "emulation", target_arch = "arm"))]
fn pend_unhandled() {
    const NUMBER: u32 = 19;
    let nvic = cortex_m::peripheral::NVIC::PTR;
    // SAFETY: it and its mask are this function's alone.
    unsafe {
        (*nvic).iser[0].write(1 << NUMBER);
        (*nvic).ispr[0].write(1 << NUMBER);
    }
    cortex_m::asm::dsb();
    cortex_m::asm::isb();
}

/// Software's interrupt of a mode that the firmware does not run in.
#[cfg(all(feature = "emulation", target_arch = "riscv32"))]
fn pend_unhandled() {
    // SAFETY: it ends the program.
    unsafe {
        riscv::register::mie::set_ssoft();
        riscv::register::mip::set_ssoft();
    }
}

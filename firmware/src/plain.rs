//! The same program as `main.rs` has it, without RTIC: for boards whose tick is an exception or an interrupt of
//! the core itself, and whose UART idle asks for its bytes.
//!
//! ```text
//! tick   every period, or for every frame in lock step: measurement in, torques out
//! idle   frames, orders, replies, logs
//! ```

use crate::application::Application;
use crate::board::Board;
use crate::control::{Control, Measurements, Order, PERIOD, Record, TickQueue};
use crate::robot::LIMITS;
use core::cell::UnsafeCell;
use surefoot::balance::Supervisor;

/// What one context has.
struct Owned<T>(UnsafeCell<T>);

// SAFETY: made before interrupts are on; afterwards each has one user, as below.
unsafe impl<T> Sync for Owned<T> {}

impl<T> Owned<T> {
    /// # Safety
    /// By one context, with no reference from an earlier call left.
    #[expect(clippy::mut_from_ref, reason = "by the caller's promise it is the only one")]
    unsafe fn get(&self) -> &mut T {
        // SAFETY: by the caller.
        unsafe { &mut *self.0.get() }
    }
}

/// The tick's.
static CONTROL: Owned<Option<Control>> = Owned(UnsafeCell::new(None));
/// Their ends are handed out once, in `connect`.
static ORDERS: Owned<TickQueue<Order>> = Owned(UnsafeCell::new(TickQueue::new()));
static MEASUREMENTS: Owned<Measurements> = Owned(UnsafeCell::new(Measurements::new()));
static RECORDS: Owned<TickQueue<Record>> = Owned(UnsafeCell::new(TickQueue::new()));

/// One tick, of the exception or interrupt that is the tick's.
#[inline(always)]
pub fn tick() {
    // SAFETY: ticks have one priority, and so do not interrupt each other.
    if let Some(control) = unsafe { CONTROL.get() } {
        control.tick();
    }
}

#[cfg(target_arch = "arm")]
#[cortex_m_rt::entry]
fn main() -> ! {
    // SAFETY: at the beginning of the program nothing else has them.
    start(Board::start(unsafe { cortex_m::Peripherals::steal() }))
}

#[cfg(target_arch = "riscv32")]
#[riscv_rt::entry]
fn main() -> ! {
    crate::no_init::paint_stack();
    start(Board::start())
}

fn start(board: Board) -> ! {
    let mut application = connect(board);
    // SAFETY: everything that the tick's handler needs is there.
    #[cfg(target_arch = "riscv32")]
    unsafe {
        riscv::interrupt::enable();
    }
    application.run()
}

/// Makes both ends. Apart, so that idle does not have its stack.
#[inline(never)]
fn connect(board: Board) -> Application {
    let Board { timer, counter, motors, watchdog, link, clock } = board;
    let supervisor = match Supervisor::new(LIMITS, PERIOD) {
        Ok(supervisor) => supervisor,
        Err(error) => {
            // With motors off, as after a reset: such an image must not run.
            defmt::error!("{}", defmt::Display2Format(&error));
            crate::board::exit()
        }
    };
    // SAFETY: here alone, and once.
    let (orders, measurements, records) =
        unsafe { (ORDERS.get(), MEASUREMENTS.get(), RECORDS.get()) };
    let (orders_in, orders_out) = orders.split();
    let (measurements_in, measurements_out) = measurements.split();
    let (records_in, records_out) = records.split();
    let control = Control::new(
        supervisor,
        counter,
        timer,
        motors,
        watchdog,
        orders_out,
        measurements_out,
        records_in,
    );
    // SAFETY: no tick has run yet.
    unsafe { *CONTROL.get() = Some(control) };
    Application::new(link, counter, clock, orders_in, measurements_in, records_out)
}

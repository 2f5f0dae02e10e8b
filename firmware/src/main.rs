//! The balance controller on a Cortex-M4F, and on the cores that `board` has besides.
//!
//! # Priorities
//! ```text
//! 4  uart   one received byte into a queue
//! 3  tick   every period, or for every frame in lock step: measurement in, torques out
//! 0  idle   frames, orders, replies, logs
//! ```
//! # Deadline
//! `uart` must read a byte before the next one is whole: 3.3 µs at 3 Mbaud, 560 cycles. It stands above
//! the tick, which takes 40 times as long. By its 29 instructions, 90 cycles with entry and exit, a tick
//! gets longer by up to a sixth while bytes come.
//!
//! `tick` must end before the next one is due: 1 ms at the default rate. What it does is bounded: at
//! most one order of each place, one measurement, one step of the supervisor. It takes no lock and waits
//! for nothing. Idle holds interrupts back only while it falls asleep, for some 20 cycles. So no log or
//! fault delays a tick, and traffic does by that share. A tick that takes longer all the same stops the
//! robot (`StopReason::Overrun`).
//!
//! Queues between priorities are bounded and have one end on each side; what finds them full is
//! dropped and counted. Measurements go by a mailbox, where the newest stays.
//!
//! # Safe state
//! On any fault motors brake for a second and are off then (`surefoot::balance::Supervisor`).
//! After a reset they are zero until the host arms the robot. The motor-enable pin is low except while
//! the torques may differ from zero. Panics and hardware faults pull it low, are logged, and reset the
//! chip; a watchdog resets a firmware that hangs.

#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
mod application;
#[cfg(target_os = "none")]
mod board;
#[cfg(target_os = "none")]
mod control;
#[cfg(target_os = "none")]
mod crash;
#[cfg(target_os = "none")]
mod log;
#[cfg(target_os = "none")]
mod logger;
#[cfg(target_os = "none")]
mod no_init;
#[cfg(all(target_os = "none", not(feature = "stm32f405")))]
mod plain;
#[cfg(all(target_os = "none", not(whole_body)))]
mod profile;
#[cfg(target_os = "none")]
mod robot;
#[cfg(all(target_os = "none", estimates))]
mod sensing;
#[cfg(all(target_os = "none", not(whole_body)))]
mod six_jointed;
#[cfg(all(target_os = "none", whole_body))]
mod stance;
#[cfg(all(target_os = "none", walks))]
mod walking;
#[cfg(all(target_os = "none", whole_body, not(walks)))]
mod whole_body;

#[cfg(all(target_os = "none", whole_body))]
use stance::{Profile, limits};
#[cfg(all(target_os = "none", walks))]
use walking::{Balance, Limits, NEEDED, standing, walker};
#[cfg(all(target_os = "none", whole_body, not(walks)))]
use whole_body::{Balance, Limits, NEEDED, standing, walker};
#[cfg(all(target_os = "none", not(whole_body)))]
use {
    profile::Profile,
    six_jointed::{Balance, Limits, NEEDED, limits, standing, walker},
};

#[cfg(all(target_os = "none", feature = "stm32f405"))]
#[rtic::app(device = crate::board::device, peripherals = true)]
mod app {
    use crate::application::Application;
    use crate::board::{Board, ByteQueue, UartReceiver};
    use crate::control::{Control, Measurements, Order, PERIOD, Record, TickQueue};
    use crate::robot::LIMITS;
    use surefoot::balance::Supervisor;

    #[shared]
    struct Shared {}

    #[local]
    struct Local {
        control: Control,
        application: Application,
        uart: UartReceiver,
    }

    #[init(local = [
        orders: TickQueue<Order> = TickQueue::new(),
        measurements: Measurements = Measurements::new(),
        records: TickQueue<Record> = TickQueue::new(),
        bytes: ByteQueue = ByteQueue::new(),
    ])]
    fn init(context: init::Context) -> (Shared, Local) {
        let (orders_in, orders_out) = context.local.orders.split();
        let (measurements_in, measurements_out) = context.local.measurements.split();
        let (records_in, records_out) = context.local.records.split();
        let (bytes_in, bytes_out) = context.local.bytes.split();
        let Board { timer, counter, motors, watchdog, uart, link, clock } =
            Board::start(context.device, context.core, bytes_in, bytes_out);
        let supervisor = match Supervisor::new(LIMITS, PERIOD) {
            Ok(supervisor) => supervisor,
            Err(error) => {
                // With motors off, as after a reset: such an image must not run.
                defmt::error!("{}", defmt::Display2Format(&error));
                loop {
                    cortex_m::asm::wfi();
                }
            }
        };
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
        let application =
            Application::new(link, counter, clock, orders_in, measurements_in, records_out);
        (Shared {}, Local { control, application, uart })
    }

    #[idle(local = [application])]
    fn idle(context: idle::Context) -> ! {
        context.local.application.run()
    }

    #[task(binds = TIM2, local = [control], priority = 3)]
    fn tick(context: tick::Context) {
        context.local.control.tick();
    }

    /// QEMU's timers do not repeat; SysTick stands in.
    #[cfg(feature = "emulation")]
    #[task(binds = SysTick, priority = 3)]
    fn due(_: due::Context) {
        crate::board::due();
    }

    #[task(binds = USART1, local = [uart], priority = 4)]
    fn uart(context: uart::Context) {
        context.local.uart.receive();
    }
}

#[cfg(not(target_os = "none"))]
fn main() {
    println!("This program is for a board; `cargo xtask test` builds it and runs it in QEMU.");
}

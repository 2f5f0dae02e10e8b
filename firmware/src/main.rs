//! The balance controller on a Cortex-M4F.
//!
//! # Priorities
//! ```text
//! 4  tick   every period, or for every frame in lock step: measurement in, torques out
//! 3  uart   one received byte into a queue
//! 0  idle   frames, orders, replies, logs
//! ```
//! # Deadline
//! `tick` must end before the next one is due: 1 ms at the default rate. What it does is bounded: at
//! most one order, one measurement, one step of the supervisor. It takes no lock and waits for
//! nothing, and nothing of lower priority masks interrupts, so that no traffic, log or fault delays
//! it. A tick that takes longer all the same stops the robot (`StopReason::Overrun`).
//!
//! Queues between priorities are bounded and have one end on each side; what finds them full is
//! dropped and counted.
//!
//! # Safe state
//! On any fault motors brake for a second and are off then (`surefoot::balance::Supervisor`).
//! After a reset they are zero until the host arms the robot. The motor-enable pin is low except while
//! the torques may differ from zero; a watchdog resets a firmware that hangs.

#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg(target_os = "none")]
mod application;
#[cfg(target_os = "none")]
mod board;
#[cfg(target_os = "none")]
mod control;
#[cfg(target_os = "none")]
mod logger;
#[cfg(target_os = "none")]
mod no_init;
#[cfg(target_os = "none")]
mod profile;

#[cfg(target_os = "none")]
#[rtic::app(device = crate::board::device, peripherals = true)]
mod app {
    use crate::application::Application;
    use crate::board::{Board, ByteQueue, UartReceiver};
    use crate::control::{Control, LIMITS, Order, PERIOD, Record, TickQueue};
    use surefoot::balance::{RobotState, Supervisor};
    use surefoot_link::LEGS;

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
        measurements: TickQueue<RobotState<f32, LEGS>> = TickQueue::new(),
        records: TickQueue<Record> = TickQueue::new(),
        bytes: ByteQueue = ByteQueue::new(),
    ])]
    fn init(context: init::Context) -> (Shared, Local) {
        let (orders_in, orders_out) = context.local.orders.split();
        let (measurements_in, measurements_out) = context.local.measurements.split();
        let (records_in, records_out) = context.local.records.split();
        let (bytes_in, bytes_out) = context.local.bytes.split();
        let Board { timer, counter, motors, watchdog, uart, link } =
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
        let application = Application::new(link, counter, orders_in, measurements_in, records_out);
        (Shared {}, Local { control, application, uart })
    }

    #[idle(local = [application])]
    fn idle(context: idle::Context) -> ! {
        context.local.application.run()
    }

    #[task(binds = TIM2, local = [control], priority = 4)]
    fn tick(context: tick::Context) {
        context.local.control.tick();
    }

    /// QEMU's timers do not repeat; SysTick stands in.
    #[cfg(feature = "emulation")]
    #[task(binds = SysTick, priority = 4)]
    fn due(_: due::Context) {
        crate::board::due();
    }

    #[task(binds = USART1, local = [uart], priority = 3)]
    fn uart(context: uart::Context) {
        context.local.uart.receive();
    }
}

/// A panic leaves the motors off: it notes itself and resets, and after a reset nothing moves until
/// the host arms the robot.
#[cfg(target_os = "none")]
#[panic_handler]
fn on_panic(_: &core::panic::PanicInfo<'_>) -> ! {
    board::restart()
}

#[cfg(not(target_os = "none"))]
fn main() {
    println!("This program is for a Cortex-M4F; `cargo xtask test` builds it and runs it in QEMU.");
}

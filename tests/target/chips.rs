//! On each chip that the firmware has an image for: the UART's driver, the timer, and crashes. Its bits and costs are
//! compared by `cargo xtask budget` (the example `chips`).

use crate::bench::{Bench, JOINTS, Target, ToTarget, image};
use crate::serial::{OverUart, connect};
use std::thread::sleep;
use std::time::{Duration, Instant};
use surefoot::balance::Mode;
use surefoot_link::{Crash, Injection, LineErrors, Pacing};
use surefoot_sim::closed_loop::firmware::{Emulator, Machine, settings};
use surefoot_sim::scene::load;

fn over_pipes(machine: &Machine) -> Target {
    let folder = env!("CARGO_TARGET_TMPDIR").as_ref();
    let emulator = Emulator::start_on(machine, &image(machine.image()), folder, &[]);
    Target::connect(emulator.expect("an emulator")).expect("a firmware that answers")
}

#[test]
#[ignore = "needs the firmware's images: `cargo xtask test --only firmware`"]
fn every_uart_carries_the_same_bits() {
    for machine in &Machine::OTHERS {
        let (_emulator, port) = OverUart::start_on(machine, machine.image());
        let mut over_uart = Bench::new(connect(&port));
        let mut over_pipes = Bench::new(over_pipes(machine));
        for _ in 0..20 {
            let (uart, pipes) = (over_uart.tick(|_| {}), over_pipes.tick(|_| {}));
            assert_eq!(uart.joint_torques, pipes.joint_torques, "{}", machine.core());
            assert_eq!(uart.mode, Mode::Active, "{}", machine.core());
        }
        let status = over_uart.target.status().expect("an answer");
        assert_eq!((status.received.corrupted, status.received.lost), (0, 0));
        assert_eq!(status.line, LineErrors::default());
    }
}

/// A timer of its own makes ticks, one a period, without a measurement and without a host that asks.
#[test]
#[ignore = "needs the firmware's images: `cargo xtask test --only firmware`"]
fn every_timer_ticks() {
    let mut settings = settings::<JOINTS>(&load("experiment-1").expect("built in"));
    (settings.pacing, settings.period) = (Pacing::FreeRunning, 0.05);
    for machine in &Machine::OTHERS {
        let core = machine.core();
        let (_emulator, port) = OverUart::start_on(machine, machine.image());
        let mut target = connect(&port);
        target.order("configure", &ToTarget::Configure(settings)).expect("obeyed");
        // Records pile up where no tick takes orders: that of `arm` comes back by its tick alone.
        let begun = Instant::now();
        let id = load("experiment-1").expect("built in").robot().id().expect("legs of six joints");
        target.order("arm", &ToTarget::Arm(id)).expect("obeyed");
        // Without measurements it stops by itself, at the third tick.
        let mut status = target.status().expect("an answer");
        while status.mode != Mode::Stopped && begun.elapsed() < Duration::from_secs(30) {
            sleep(Duration::from_millis(20));
            status = target.status().expect("an answer");
        }
        assert_eq!((status.mode, status.overruns), (Mode::Stopped, 0), "{core}");
        let last = status.log.stops.last().expect("a stop in the log");
        assert_eq!(last.reason, surefoot::balance::StopReason::Stale, "{core}");
    }
}

#[test]
#[ignore = "needs the firmware's images: `cargo xtask test --only firmware`"]
fn every_crash_is_logged_and_resets() {
    for machine in &Machine::OTHERS {
        let mut target = over_pipes(machine);
        for (number, crash) in [
            Crash::Panic { line: 0 },
            Crash::HardFault { at: 0, status: 0 },
            Crash::Unhandled { number: 0 },
        ]
        .into_iter()
        .enumerate()
        {
            let core = machine.core();
            target.reset(Injection::Crash(crash)).expect("an answer");
            let status = target.status().expect("an answer");
            assert_eq!(status.log.crashes as usize, number + 1, "{core}");
            let logged = status.log.crash.expect("a crash in the log");
            println!("{core}: {logged:?}");
            match (crash, logged) {
                (Crash::Panic { .. }, Crash::Panic { line }) => assert!(line > 0, "{core}"),
                (Crash::HardFault { .. }, Crash::HardFault { at, .. }) => assert!(at > 0, "{core}"),
                (Crash::Unhandled { .. }, Crash::Unhandled { number }) => {
                    assert!(number > 0, "{core}")
                }
                (wanted, found) => panic!("{core}: {found:?}, and it was {wanted:?}"),
            }
        }
    }
}

//! The UART's driver and framing, as on a board: QEMU's first UART is a pseudo-terminal, which is
//! opened as a serial port.

use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;
use surefoot::balance::Mode;
use surefoot_link::{LineErrors, Pacing};
use surefoot_sim::closed_loop::firmware::{Machine, SerialPort, settings};
use surefoot_sim::scene::load;

use crate::bench::{Bench, JOINTS, Target, ToTarget, image, target};

/// An emulator without pipes; it ends with this value.
pub struct OverUart(Child);

impl OverUart {
    /// # Returns
    /// The emulator, and the pseudo-terminal's path.
    pub fn start(name: &str) -> (Self, String) {
        Self::start_on(&Machine::REFERENCE, name)
    }

    /// The same on another machine.
    pub fn start_on(machine: &Machine, name: &str) -> (Self, String) {
        let folder = env!("CARGO_TARGET_TMPDIR");
        let mut child = Command::new(machine.program())
            .args(machine.arguments())
            .args(["-nographic", "-monitor", "none", "-serial", "pty"])
            .arg("-kernel")
            .arg(image(name))
            .current_dir(folder)
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("QEMU starts");
        // "char device redirected to /dev/pts/3 (label serial0)", and then what the firmware logs.
        let mut output = BufReader::new(child.stdout.take().expect("piped"));
        let mut line = Vec::new();
        output.read_until(b'\n', &mut line).expect("a line");
        let line = String::from_utf8_lossy(&line).into_owned();
        let port = line.split_whitespace().find(|word| word.starts_with("/dev/")).expect("a path");
        let port = port.to_owned();
        std::thread::spawn(move || std::io::copy(&mut output, &mut std::io::sink()));
        (Self(child), port)
    }
}

impl Drop for OverUart {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

pub fn connect(port: &str) -> Target {
    Target::connect(SerialPort::open(port).expect("a port")).expect("a firmware that answers")
}

#[test]
#[ignore = "needs the firmware's images: `cargo xtask test --only firmware`"]
fn the_uart_carries_the_same_bits() {
    let (_emulator, port) = OverUart::start("emulation");
    let mut over_uart = Bench::new(connect(&port));
    let mut over_pipes = Bench::new(target());
    for _ in 0..60 {
        let (uart, pipes) = (over_uart.tick(|_| {}), over_pipes.tick(|_| {}));
        assert_eq!(uart.joint_torques, pipes.joint_torques);
        assert_eq!(uart.mode, Mode::Active);
    }
    let received = over_uart.target.status().expect("an answer").received;
    assert_eq!((received.corrupted, received.lost), (0, 0));
    let line = over_uart.target.status().expect("an answer").line;
    assert_eq!(line, LineErrors::default());
}

/// On its own timer, with every tick logged: none is late, none overruns; and when the host falls
/// silent, the robot stops. An emulated UART is no match for 1 kHz, so that the period is longer here.
#[test]
#[ignore = "needs the firmware's images: `cargo xtask test --only firmware`"]
fn a_free_running_target_keeps_its_deadline_and_stops_without_its_host() {
    let scene = load("experiment-1").expect("built in");
    let mut settings = settings::<JOINTS>(&scene);
    settings.pacing = Pacing::FreeRunning;
    settings.period = 0.09;
    // While this side waits for its turn on the machine the target's clock may run on by more ticks than are bridged:
    // it then stops, rightly, and is begun again.
    let in_time = (0..10).find_map(|_| {
        let (emulator, port) = OverUart::start("emulation");
        let mut target = connect(&port);
        target.order("configure", &ToTarget::Configure(settings)).expect("obeyed");
        sleep(Duration::from_millis(300));
        let status = target.status().expect("an answer");
        assert_eq!((status.mode, status.overruns), (Mode::Standby, 0));
        target
            .order("arm", &ToTarget::Arm(scene.robot().id().expect("legs of six joints")))
            .expect("obeyed");
        let measurement = target.measurement(&Bench::sensors_of(&scene));
        let frame = target.frame(&measurement);
        let torques = target.tick_raw(&frame).expect("an answer");
        // In a frame of its own, and still no measurement: it has been one.
        let frame = target.frame(&measurement);
        target.send_raw(&frame).expect("sent");
        (torques.mode == Mode::Active).then_some((emulator, target, torques))
    });
    let (_emulator, mut target, torques) = in_time.expect("a measurement that comes in time");
    let per_microsecond = target.identity().per_second / 1_000_000;
    println!("late by {} instructions", torques.latency);
    assert!(torques.latency <= 2 * per_microsecond, "late by {} instructions", torques.latency);
    // Eight ticks later at the most; how long that is by the clock on the wall is QEMU's affair.
    let mut status = target.status().expect("an answer");
    for _ in 0..200 {
        if status.mode == Mode::Stopped {
            break;
        }
        sleep(Duration::from_millis(50));
        status = target.status().expect("an answer");
    }
    assert_eq!(status.mode, Mode::Stopped);
    assert_eq!((status.overruns, status.measurements_stale), (0, 1));
    let last = status.log.stops.last().expect("a stop in the log");
    assert_eq!(last.reason, surefoot::balance::StopReason::Stale);
    // The tick after the measurement is bridged, the next one stops.
    assert_eq!(last.tick, torques.tick + 2);
}

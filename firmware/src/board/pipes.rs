//! The link of an emulated board by semihosting: two named pipes where the emulator's folder has them, and the
//! UART otherwise; logs on the emulator's standard output.

use super::Uart;
use semihosting::fs::File;
use semihosting::io::{Read, Write};

/// Two pipes where the emulator's folder has them, and the UART otherwise.
pub enum Link {
    /// From the host, and to it.
    Pipes(File, File),
    /// As on hardware.
    Uart(Uart),
}

/// Looks for the pipes.
pub fn link(uart: Uart) -> Link {
    let from_host = File::open(c"to-target");
    let to_host = File::create(c"to-host");
    match (from_host, to_host) {
        (Ok(from_host), Ok(to_host)) => Link::Pipes(from_host, to_host),
        _ => Link::Uart(uart),
    }
}

impl Link {
    /// Whether something has arrived. Over pipes that is known by waiting for it.
    pub fn has_bytes(&self) -> bool {
        match self {
            Self::Pipes(..) => true,
            Self::Uart(uart) => uart.has_bytes(),
        }
    }

    /// What has arrived. Over pipes the machine stands still until something does.
    pub fn receive(&mut self, buffer: &mut [u8]) -> usize {
        match self {
            Self::Pipes(from_host, _) => match from_host.read(buffer) {
                // Nobody is at the other end any more.
                Ok(0) | Err(_) => exit(),
                Ok(received) => received,
            },
            Self::Uart(uart) => uart.receive(buffer),
        }
    }

    /// Sends all bytes.
    pub fn send(&mut self, bytes: &[u8]) {
        match self {
            Self::Pipes(_, to_host) => {
                if to_host.write_all(bytes).is_err() {
                    exit();
                }
            }
            Self::Uart(uart) => uart.send(bytes),
        }
    }
}

/// Does not sleep: an emulator that sleeps lets time go by the clock on the wall.
pub fn sleep_unless(_: impl FnOnce() -> bool) {}

/// Ends the emulator.
pub fn exit() -> ! {
    semihosting::process::exit(0)
}

/// Logs.
pub fn log(bytes: &[u8]) {
    if let Ok(mut out) = semihosting::io::stdout() {
        let _ = out.write_all(bytes);
    }
}

//! The firmware in QEMU, talked to over two named pipes.

use super::{LinkError, Transport};
use std::fs::{File, OpenOptions};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::Duration;

/// QEMU's program for Arm.
const QEMU: &str = "qemu-system-arm";
/// The copy that `cargo xtask firmware` unpacks where it cannot be installed.
const OWN_COPY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../target/qemu/qemu-system-arm");

/// A running emulator; it ends with this value.
pub struct Emulator {
    child: Child,
    /// Holds the pipes and the output.
    folder: PathBuf,
    to_target: File,
    from_target: Receiver<Vec<u8>>,
}

impl Emulator {
    /// The program: the workspace's own copy, if there is one, or the machine's.
    pub fn program() -> &'static str {
        if Path::new(OWN_COPY).exists() { OWN_COPY } else { QEMU }
    }

    /// Starts QEMU with an image of the firmware built for emulation, in a new folder of its own
    /// below `folder`.
    ///
    /// # Errors
    /// A [`LinkError`] that says what is missing.
    pub fn start(image: &Path, folder: &Path) -> Result<Self, LinkError> {
        Self::start_with(image, folder, &[])
    }

    /// The same, with more arguments for QEMU.
    ///
    /// # Errors
    /// As before.
    pub fn start_with(image: &Path, folder: &Path, arguments: &[&str]) -> Result<Self, LinkError> {
        let error = |what: &dyn std::fmt::Display| {
            let what = what.to_string();
            move |source| LinkError::Io { what, source }
        };
        let image = image.canonicalize().map_err(error(&format!(
            "{}: the firmware for the emulator (`cargo xtask firmware` builds it)",
            image.display()
        )))?;
        let folder = folder.join(format!("emulator-{}-{}", std::process::id(), next_number()));
        std::fs::create_dir_all(&folder).map_err(error(&folder.display()))?;
        for pipe in ["to-target", "to-host"] {
            let path = folder.join(pipe);
            let made = Command::new("mkfifo").arg(&path).status();
            match made {
                Ok(status) if status.success() => {}
                Ok(status) => {
                    let source = std::io::Error::other(status.to_string());
                    return Err(error(&path.display())(source));
                }
                Err(source) => return Err(error(&"mkfifo")(source)),
            }
        }
        let output = folder.join("output");
        let output = File::create(&output).map_err(error(&output.display()))?;
        let child = Command::new(Self::program())
            .args([
                "-machine",
                "netduinoplus2",
                "-nographic",
                "-monitor",
                "none",
                "-serial",
                "none",
            ])
            .args(["-semihosting-config", "enable=on,target=native", "-icount", "shift=4"])
            .args(arguments)
            .arg("-kernel")
            .arg(&image)
            .current_dir(&folder)
            .stdin(Stdio::null())
            .stderr(output.try_clone().map_err(error(&"the emulator's output"))?)
            .stdout(output)
            .spawn()
            .map_err(error(&format!("{} (`cargo xtask test` installs it)", Self::program())))?;

        // Opened for both directions a pipe does not wait for its other end.
        let both = |name: &str| {
            let path = folder.join(name);
            OpenOptions::new().read(true).write(true).open(&path).map_err(error(&path.display()))
        };
        let to_target = both("to-target")?;
        let mut to_host = both("to-host")?;
        let (bytes_in, from_target) = channel();
        // It ends with the first byte that nobody takes any more; `drop` sends that.
        std::thread::spawn(move || {
            let mut buffer = [0; 1024];
            while let Ok(received) = to_host.read(&mut buffer) {
                if bytes_in.send(buffer[..received].to_vec()).is_err() {
                    break;
                }
            }
        });
        Ok(Self { child, folder, to_target, from_target })
    }

    /// Where the emulator's output is: log frames and messages of QEMU.
    pub fn output(&self) -> PathBuf {
        self.folder.join("output")
    }
}

/// Tells the folders of one process apart.
fn next_number() -> u32 {
    use std::sync::atomic::{AtomicU32, Ordering};
    static NUMBER: AtomicU32 = AtomicU32::new(0);
    NUMBER.fetch_add(1, Ordering::Relaxed)
}

impl Transport for Emulator {
    fn send(&mut self, bytes: &[u8]) -> Result<(), LinkError> {
        self.to_target
            .write_all(bytes)
            .map_err(|source| LinkError::Io { what: "pipe to the emulator".into(), source })
    }

    fn receive(&mut self, patience: Duration) -> Result<Vec<u8>, LinkError> {
        let tenth = patience / 10;
        for _ in 0..10 {
            match self.from_target.recv_timeout(tenth) {
                Ok(bytes) => return Ok(bytes),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => break,
            }
            if let Ok(Some(status)) = self.child.try_wait() {
                let output = std::fs::read(self.output()).unwrap_or_default();
                let output = String::from_utf8_lossy(&output);
                return Err(LinkError::Ended(format!("{status}; {}", output.trim())));
            }
        }
        Err(LinkError::Silent(patience))
    }
}

impl Drop for Emulator {
    /// Errors have nobody to go to here: the process may have ended, and files may be gone.
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
        let (_, nobody) = channel();
        self.from_target = nobody;
        if let Ok(mut pipe) = OpenOptions::new().write(true).open(self.folder.join("to-host")) {
            let _ = pipe.write_all(&[0]);
        }
        let _ = std::fs::remove_dir_all(&self.folder);
    }
}

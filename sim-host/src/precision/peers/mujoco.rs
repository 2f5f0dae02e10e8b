//! MuJoCo, in a process of its own that answers line by line. It runs while this program waits, on one thread: a
//! program that is held to one core holds it to the same.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::sync::Mutex;

/// Where `cargo xtask peers` installs it.
const PYTHON: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../target/peers/python/bin/python");

/// Why MuJoCo does not answer.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NoMujoco {
    /// It is not there.
    #[error("MuJoCo is not installed; `cargo xtask peers` installs it below the target folder")]
    NotInstalled,
    /// It does not start, or has ended.
    #[error("MuJoCo has stopped: {0}")]
    Stopped(String),
}

/// MuJoCo on its way.
pub struct Mujoco {
    /// Which one.
    pub version: String,
    pipes: Mutex<Pipes>,
}

struct Pipes {
    child: Child,
    to: ChildStdin,
    from: BufReader<ChildStdout>,
}

#[derive(Deserialize)]
struct Greeting {
    version: String,
}

impl Mujoco {
    /// Starts it from where `cargo xtask peers` has put it.
    ///
    /// # Errors
    /// A [`NoMujoco`].
    pub fn start() -> Result<Self, NoMujoco> {
        if !Path::new(PYTHON).exists() {
            return Err(NoMujoco::NotInstalled);
        }
        let mut child = Command::new(PYTHON)
            .args(["-c", include_str!("mujoco_runs.py")])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .map_err(|error| stopped(&error))?;
        let (Some(to), Some(from)) = (child.stdin.take(), child.stdout.take()) else {
            return Err(stopped(&"it has no pipes"));
        };
        let mut pipes = Pipes { child, to, from: BufReader::new(from) };
        let Greeting { version } = pipes.answer()?;
        Ok(Self { version, pipes: Mutex::new(pipes) })
    }

    /// Asks, and waits: two minutes at most, after which it ends itself.
    ///
    /// # Errors
    /// [`NoMujoco::Stopped`].
    pub(super) fn ask<A: DeserializeOwned>(&self, request: &impl Serialize) -> Result<A, NoMujoco> {
        let mut pipes = self.pipes.lock().map_err(|error| stopped(&error))?;
        let text = serde_json::to_string(request).map_err(|error| stopped(&error))?;
        writeln!(pipes.to, "{text}").map_err(|error| stopped(&error))?;
        pipes.answer()
    }
}

impl Pipes {
    fn answer<A: DeserializeOwned>(&mut self) -> Result<A, NoMujoco> {
        let mut line = String::new();
        let read = self.from.read_line(&mut line).map_err(|error| stopped(&error))?;
        if read == 0 {
            return Err(stopped(&"no answer"));
        }
        serde_json::from_str(&line).map_err(|error| stopped(&error))
    }
}

impl Drop for Pipes {
    fn drop(&mut self) {
        // It may have ended already.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn stopped(reason: &dyn std::fmt::Display) -> NoMujoco {
    NoMujoco::Stopped(reason.to_string())
}

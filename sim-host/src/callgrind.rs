//! Instructions that this program executes, by valgrind's tool callgrind, for what it is asked to do.

use clap::ValueEnum;
use std::ffi::OsStr;
use std::path::Path;
use std::process::Command;
use std::sync::atomic::{AtomicU32, Ordering};

/// Why instructions have not been counted.
#[derive(Debug, thiserror::Error)]
pub enum CountFailure {
    /// Valgrind is not there.
    #[error("valgrind, which counts instructions, cannot be run here: {0}")]
    NoValgrind(std::io::Error),
    /// It has not done what it was asked for.
    #[error("valgrind has not counted: {0}")]
    NoCount(String),
}

/// The name of a value on this program's command line.
pub fn word(value: impl ValueEnum) -> String {
    value.to_possible_value().map_or_else(String::new, |named| named.get_name().to_owned())
}

/// Instructions of a run of this program with these arguments, its start and end included.
///
/// # Errors
/// A [`CountFailure`].
///
/// # Cost
/// Some fifty times the run's own time, and half a second.
pub fn instructions(arguments: &[&OsStr]) -> Result<u64, CountFailure> {
    // Files of runs at the same time are not each other's.
    static RUNS: AtomicU32 = AtomicU32::new(0);
    let no_count = |reason: &dyn std::fmt::Display| CountFailure::NoCount(reason.to_string());
    let program = std::env::current_exe().map_err(|error| no_count(&error))?;
    let run = RUNS.fetch_add(1, Ordering::Relaxed);
    let file =
        std::env::temp_dir().join(format!("surefoot-{}-{run}.callgrind", std::process::id()));
    let output = Command::new("valgrind")
        .args(["--quiet", "--tool=callgrind"])
        .arg(format!("--callgrind-out-file={}", file.display()))
        .arg(program)
        .args(arguments)
        .output()
        .map_err(CountFailure::NoValgrind)?;
    let found = total(&file);
    // It may not have been made.
    let _ = std::fs::remove_file(&file);
    if !output.status.success() {
        return Err(no_count(&String::from_utf8_lossy(&output.stderr)));
    }
    found.ok_or_else(|| no_count(&"its file has no total"))
}

fn total(file: &Path) -> Option<u64> {
    let text = std::fs::read_to_string(file).ok()?;
    text.lines().rev().find_map(|line| line.strip_prefix("totals: "))?.trim().parse().ok()
}

//! Instructions of steps, by callgrind on this program itself: what a run with two copies of a model executes
//! more than one with one copy is that model's steps, and nothing else.

use std::path::Path;
use std::process::Command;

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

/// Instructions of one step, the mean over so many seconds of a motion: that of the scene which can be opened by
/// `name`, on the rung of this name.
///
/// # Errors
/// A [`CountFailure`].
pub fn count(name: &str, duration_s: f64, rung: &str, steps: u64) -> Result<u64, CountFailure> {
    let total = |copies: usize| total(name, duration_s, rung, copies);
    let (one, two) = (total(1)?, total(2)?);
    Ok(two.saturating_sub(one) / steps.max(1))
}

fn total(name: &str, duration_s: f64, rung: &str, copies: usize) -> Result<u64, CountFailure> {
    let program = std::env::current_exe().map_err(|error| no_count(&error))?;
    let file = std::env::temp_dir()
        .join(format!("surefoot-{}-{rung}-{copies}.callgrind", std::process::id()));
    let output = Command::new("valgrind")
        .args(["--quiet", "--tool=callgrind"])
        .arg(format!("--callgrind-out-file={}", file.display()))
        .arg(program)
        .args(["count-steps", name, rung, &copies.to_string()])
        .args(["--duration", &duration_s.to_string()])
        .output()
        .map_err(CountFailure::NoValgrind)?;
    let found = read(&file);
    // It may not have been made.
    let _ = std::fs::remove_file(&file);
    if !output.status.success() {
        return Err(no_count(&String::from_utf8_lossy(&output.stderr)));
    }
    found.ok_or_else(|| no_count(&"its file has no total"))
}

fn read(file: &Path) -> Option<u64> {
    let text = std::fs::read_to_string(file).ok()?;
    text.lines().rev().find_map(|line| line.strip_prefix("totals: "))?.trim().parse().ok()
}

fn no_count(reason: &dyn std::fmt::Display) -> CountFailure {
    CountFailure::NoCount(reason.to_string())
}

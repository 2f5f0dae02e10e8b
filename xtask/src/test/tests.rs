//! Unit tests and the suite, on the host.

use crate::{instructions::provide_valgrind, workspace};
use anyhow::{Context, Result};

/// Runs the tests of all crates, to the end even when one fails.
pub fn run() -> Result<&'static str> {
    // Without it tests that gate instructions hold only that its absence is told.
    if let Err(error) = provide_valgrind() {
        eprintln!("instructions are not counted: {error:#}");
    }
    // `--tests` are unit tests, integration tests and those of binaries; documentation has its own
    // stage.
    workspace::cargo(["test", "--workspace", "--tests", "--no-fail-fast"])
        .run()
        .context("a test fails, as is said above under its name")?;
    Ok("unit tests and suite, on the host")
}

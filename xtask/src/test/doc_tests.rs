//! The examples in the documentation, on the host.

use crate::workspace;
use anyhow::{Context, Result};

/// Compiles and runs the documentation's examples.
pub fn run() -> Result<&'static str> {
    workspace::cargo(["test", "--workspace", "--doc", "--no-fail-fast"])
        .run()
        .context("an example in the documentation fails, as is said above at its line")?;
    Ok("examples of the documentation, on the host")
}

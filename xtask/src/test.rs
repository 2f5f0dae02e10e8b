//! `cargo xtask test`: everything, on a machine that has nothing but a Rust toolchain.

use crate::panic_free;
use crate::shell::{cargo, run};
use anyhow::{Context, Result};
use std::time::Instant;

/// A named part of the tests.
type Stage = (&'static str, fn() -> Result<()>);

const STAGES: [Stage; 2] = [
    ("host: unit tests, suite, command line, doc tests", || {
        run(cargo().args(["test", "--workspace", "--exclude", "xtask"]))
    }),
    ("target: core on a Cortex-M4F, no panicking path", panic_free::target),
];

/// Runs all stages; stops at the first that fails.
///
/// # Errors
/// That of the stage.
pub fn test() -> Result<()> {
    let mut lines = Vec::new();
    for (number, (name, stage)) in STAGES.iter().enumerate() {
        eprintln!("\n== {}/{} {name}", number + 1, STAGES.len());
        let started = Instant::now();
        stage().with_context(|| format!("stage '{name}' failed"))?;
        lines.push(format!("  {:6.1} s  {name}", started.elapsed().as_secs_f64()));
    }
    println!("\nall stages passed\n{}", lines.join("\n"));
    Ok(())
}

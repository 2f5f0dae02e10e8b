//! Core compiles for the target.

use crate::toolchain::{TARGET, Toolchain};
use anyhow::{Context, Result};

/// Compiles core for the target, as a library, with nothing of the standard library to lean on.
pub fn run(arm: &Toolchain) -> Result<String> {
    arm.cargo("build").args(["--release", "--package", "surefoot"]).run().context(
        "core does not compile for the target, which has no standard library and no heap",
    )?;
    Ok(format!("core compiles for {TARGET}"))
}

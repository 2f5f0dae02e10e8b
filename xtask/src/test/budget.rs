//! The firmware keeps its budget.

use crate::arm_toolchain::ArmToolchain;
use crate::budget::{self, measure};
use crate::firmware;
use anyhow::{Result, ensure};

/// Builds, measures, and compares.
pub fn run(arm: &ArmToolchain) -> Result<String> {
    firmware::build(arm, &firmware::Robot::of_the_text()?)?;
    firmware::build_variants(arm)?;
    let report = measure(arm)?;
    budget::print(&report);
    ensure!(report.broken().is_empty(), "over budget: {}", report.broken().join("; "));
    Ok(format!("a tick takes {} instructions at most", report.instructions.max))
}

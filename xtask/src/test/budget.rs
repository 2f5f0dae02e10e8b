//! The firmware keeps its budget.

use crate::budget::{self, measure};
use crate::firmware;
use crate::toolchain::Toolchain;
use anyhow::{Result, bail, ensure};

/// Builds, measures, and compares.
pub fn run(arm: &Toolchain) -> Result<String> {
    let robot = firmware::Robot::of_the_text()?;
    firmware::build(arm, &robot)?;
    firmware::build_variants(arm)?;
    firmware::build_for_other_chips(&robot)?;
    let report = measure(arm)?;
    budget::print(&report);
    ensure!(report.broken().is_empty(), "over budget: {}", report.broken().join("; "));
    if let Some(outdated) = budget::outdated(&report)? {
        bail!(outdated);
    }
    Ok(format!("a tick takes {} instructions at most", report.instructions.max))
}

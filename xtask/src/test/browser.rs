//! The report's page and its replay, in a browser.

use crate::step::Step;
use crate::workspace::{self, Built};
use crate::{apt, page};
use anyhow::{Context, Result};

/// Runs the tests that look at the page in Chromium, without a window.
pub fn run() -> Result<String> {
    let browser = provide_browser()?;
    page::build(Built::WithTests)?;
    workspace::ignored_tests("browser").run()?;
    Ok(format!("report, replay and the page to try it on in {browser}"))
}

/// # Returns
/// The version of the browser that this machine has, or is given.
fn provide_browser() -> Result<String> {
    let version = Step::new("chromium", ["--version"]);
    if !version.succeeds() {
        apt::install("chromium").context(
            "the report is looked at in the browser Chromium, which is not installed and cannot be",
        )?;
    }
    Ok(version.read()?.lines().next().unwrap_or_default().trim().to_owned())
}

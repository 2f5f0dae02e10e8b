//! The report's page and its replay, in a browser.

use crate::step::Step;
use crate::{apt, page, workspace};
use anyhow::{Context, Result};

/// Runs the tests that look at the page in Chromium, without a window.
pub fn run() -> Result<String> {
    let browser = provide_browser()?;
    // The page to try the robot on has a stage of its own.
    workspace::ignored_tests("browser").args(["--skip", "live::"]).run()?;
    Ok(format!("report and replay in {browser}"))
}

/// Builds the page in which the controller and its plant run, and tries it.
pub fn of_page() -> Result<String> {
    let browser = provide_browser()?;
    page::build()?;
    workspace::ignored_tests("browser").args(["live::"]).run()?;
    Ok(format!("the page to try the robot on in {browser}"))
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

//! The crates that can be published are whole, and compile with the oldest compiler that they say.

use crate::step::Step;
use crate::workspace;
use anyhow::{Context, Result};

/// Those that can be published.
const PACKAGES: [&str; 2] = ["surefoot", "surefoot-link"];

/// Makes the packages, and compiles each from what is in it.
pub fn run() -> Result<String> {
    let chosen = PACKAGES.into_iter().flat_map(|package| ["--package", package]);
    // Of this commit or not: what is tested is what would be sent.
    workspace::cargo(["package", "--offline", "--allow-dirty", "--quiet"])
        .args(chosen.clone())
        .run()
        .context(
            "a crate that is to be published is not whole: a file that its `include` leaves out?",
        )?;
    Ok(format!("packages of {}; {}", PACKAGES.join(" and "), oldest_compiler(chosen)?))
}

/// The manifest says it, once.
fn oldest_compiler<'a>(packages: impl Iterator<Item = &'a str>) -> Result<String> {
    let oldest = env!("CARGO_PKG_RUST_VERSION");
    let said = workspace::rustc(["--version"]).read()?;
    let release = said.split_whitespace().nth(1).unwrap_or_default();
    if release.strip_prefix(oldest).is_some_and(|patch| patch.starts_with('.')) {
        return Ok(format!("all stages ran with the oldest compiler, {oldest}"));
    }
    let toolchain = format!("+{oldest}");
    if !Step::new("cargo", [toolchain.as_str(), "--version"]).succeeds() {
        return Ok(format!(
            "not compiled with Rust {oldest}, the oldest: `rustup toolchain install {oldest}` has it tried"
        ));
    }
    Step::new("cargo", [toolchain.as_str(), "check", "--offline"])
        .args(packages)
        .run()
        .with_context(|| {
            format!("a crate does not compile with Rust {oldest}, as its manifest says")
        })?;
    Ok(format!("they compile with the oldest compiler, {oldest}"))
}

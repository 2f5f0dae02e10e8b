//! The tick on the target: does it compile, and can it panic?
//!
//! The program `surefoot-panic-free` links the f32 tick with link-time optimisation and drops what
//! nothing calls. So a symbol of `core::panicking` in it means that some path of the tick calls it.
//! A second build, with a panicking path on purpose, shows that the check finds one.

use crate::arm_toolchain::{ArmToolchain, TARGET, arm_toolchain};
use crate::shell::{root, run};
use anyhow::{Context, Result, bail};
use object::{Object, ObjectSection, ObjectSymbol, SectionKind};

/// Parts of the names of functions that end in a panic.
const PANICS: [&str; 6] = [
    "core::panicking",
    "panic_fmt",
    "panic_bounds_check",
    "unwrap_failed",
    "expect_failed",
    "rust_begin_unwind",
];

/// Builds for the target and checks.
///
/// # Errors
/// If it does not compile, if a path panics, or if the check is blind.
pub fn target() -> Result<()> {
    let toolchain = arm_toolchain()?;
    eprintln!("target compiler: {}", toolchain.name());

    run(toolchain.cargo("build").args(["--release", "--package", "surefoot"]))?;

    let (proof, _) = inspect(&toolchain, &["--features", "prove-check"])?;
    if proof.is_empty() {
        bail!("the check does not see a panicking path that was put in on purpose");
    }
    let (found, bytes) = inspect(&toolchain, &[])?;
    if !found.is_empty() {
        bail!("the tick can panic; the linked program has:\n  {}", found.join("\n  "));
    }
    println!(
        "no panicking path in the f32 tick for {TARGET} (a planted one is found: {}); \
         {bytes} bytes of flash with start-up code and model",
        proof.len()
    );
    Ok(())
}

/// Panicking functions in the linked program, and its size in flash.
fn inspect(toolchain: &ArmToolchain, extra: &[&str]) -> Result<(Vec<String>, u64)> {
    run(toolchain
        .cargo("build")
        .args(["--release", "--package", "surefoot-panic-free"])
        .args(extra))?;
    let path = root().join("target/arm").join(TARGET).join("release/surefoot-panic-free");
    let bytes = std::fs::read(&path).with_context(|| path.display().to_string())?;
    let elf = object::File::parse(&*bytes).with_context(|| path.display().to_string())?;
    let names: Vec<String> = elf
        .symbols()
        .filter(|symbol| symbol.is_definition())
        .filter_map(|symbol| symbol.name().ok().map(|name| rustc_demangle::demangle(name).to_string()))
        .collect();
    // A stripped program would show nothing and prove nothing.
    if !names.iter().any(|name| name.contains("run_tick")) {
        bail!("{}: the tick is not among the symbols", path.display());
    }
    let found =
        names.into_iter().filter(|name| PANICS.iter().any(|panic| name.contains(panic))).collect();
    let flash = elf
        .sections()
        .filter(|section| {
            matches!(section.kind(), SectionKind::Text | SectionKind::ReadOnlyData | SectionKind::Data)
        })
        .map(|section| section.size())
        .sum();
    Ok((found, flash))
}

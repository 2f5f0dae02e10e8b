//! No panicking path in core, shown on linked images of the target.

use crate::image::{self, Panicking};
use crate::step::Step;
use crate::toolchain::Toolchain;
use crate::workspace;
use anyhow::{Context, Result, bail, ensure};
use std::collections::BTreeMap;
use std::fmt::Write;

const PACKAGE: &str = "surefoot-panic-free";

/// Images that must not be able to panic: the tick, the one within limits, the one of any robot, the one of feet
/// that swing, the planner of walks, the observer, quadratic programs, the state estimator, and the rest of core.
const CLAIMS: [&str; 9] = [
    "panic-free-tick",
    "panic-free-limited",
    "panic-free-whole-body",
    "panic-free-motion",
    "panic-free-observer",
    "panic-free-walk",
    "panic-free-qp",
    "panic-free-dynamics",
    "panic-free-estimate",
];

/// An image that can panic on purpose; a check that finds nothing in it is broken.
const COUNTEREXAMPLE: &str = "panic-free-counterexample";

/// Keeps the calls of panicking functions apart, which the optimiser otherwise merges into one that
/// comes from no line in particular. It makes images larger, so that only a search for culprits has
/// it.
const CALLS_APART: [&str; 3] = ["--", "-C", "llvm-args=-enable-tail-merge=false"];

/// What the check reads off an image.
struct Findings {
    panicking: Vec<Panicking>,
    flash_bytes: u64,
}

/// Links the images and reads them.
pub fn run(arm: &Toolchain) -> Result<String> {
    let images = build(arm.cargo("build"), [])?;
    let of = |name: &str| images.get(name).with_context(|| format!("cargo has not built {name}"));

    ensure!(
        of(COUNTEREXAMPLE)?.panicking.iter().any(|found| !found.sites.is_empty()),
        "the check is broken: in {COUNTEREXAMPLE}, which panics on purpose, it finds no call of a \
         panicking function.\nTo mend it, see which names `nm --demangle` has for the panic handler \
         there, and teach them to xtask/src/image/panicking.rs."
    );
    let mut complaint = String::new();
    let mut summary = Vec::new();
    for claim in CLAIMS {
        let findings = of(claim)?;
        if !findings.panicking.is_empty() {
            complaint += &complain(claim, arm)?;
        }
        summary.push(format!("{claim} ({} bytes of flash)", findings.flash_bytes));
    }
    if !complaint.is_empty() {
        bail!(
            "core can panic on the target.{complaint}\n\
             To mend it, index through iterators, `get` or arrays of known length, and return a \
             typed fault for what cannot be."
        );
    }
    Ok(format!("no panicking path in {}", summary.join(", ")))
}

/// Links images and reads them.
///
/// # Returns
/// What was found, by the images' names.
fn build<const N: usize>(cargo: Step, last: [&str; N]) -> Result<BTreeMap<String, Findings>> {
    let cargo = cargo.args(["--release", "--package", PACKAGE]);
    let mut images = BTreeMap::new();
    for path in workspace::executables(cargo, last)? {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let findings = std::fs::read(&path)
            .map_err(Into::into)
            .and_then(|contents| read(&contents))
            .with_context(|| format!("cannot read the image {}", path.display()))?;
        images.insert(name, findings);
    }
    Ok(images)
}

fn read(contents: &[u8]) -> Result<Findings> {
    let image = image::parse(contents)?;
    Ok(Findings { panicking: image::panicking(&image)?, flash_bytes: image::flash_bytes(&image) })
}

/// What to say of an image that can panic: which functions it reaches, from where.
fn complain(name: &str, arm: &Toolchain) -> Result<String> {
    let images = build(arm.cargo("rustc").args(["--bin", name]), CALLS_APART)?;
    let panicking = &images.get(name).context("cargo has not built it again")?.panicking;
    let mut complaint = String::new();
    for Panicking { function, sites } in panicking.iter().filter(|found| !found.sites.is_empty()) {
        write!(complaint, "\n  {name} reaches {function}")?;
        for site in sites {
            write!(complaint, "\n    from {site}")?;
        }
    }
    if complaint.is_empty() {
        let names: Vec<&str> = panicking.iter().map(|found| found.function.as_str()).collect();
        write!(complaint, "\n  {name} holds {}, called from nowhere known", names.join(", "))?;
    }
    Ok(complaint)
}

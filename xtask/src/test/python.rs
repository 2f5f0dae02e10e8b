//! Python's package: its module as the tests' build makes it, and its tests.

use crate::step::Step;
use crate::{apt, workspace};
use anyhow::{Context, Result};
use std::path::{Path, PathBuf};

/// What the package and its tests need.
const PACKAGES: [&str; 2] = ["numpy==2.4.6", "pytest==9.2.0"];
/// What studies on clusters need besides.
const CLUSTERS: [&str; 2] = ["dask[distributed]==2026.8.0", "ray==2.60.0"];
/// Seconds for the download.
const INSTALL_LIMIT: u64 = 1200;
/// Succeeds where a Python has all packages in these versions.
const PROBE: &str = "import importlib.metadata as m, sys
for package in sys.argv[1:]:
    name, version = package.split('==')
    assert m.version(name.split('[')[0]) == version, package";

/// Tests of the package, but for those on clusters.
pub fn run() -> Result<String> {
    let python = python("python", &PACKAGES)?;
    tested(&python, &["tests", "--ignore=tests/test_clusters.py"])?;
    Ok(format!("the package for Python, with {}", PACKAGES.join(", ")))
}

/// The examples on clusters of which a worker is killed.
pub fn on_clusters() -> Result<String> {
    let all = [PACKAGES, CLUSTERS].concat();
    let python = python("python-clusters", &all)?;
    tested(&python, &["tests/test_clusters.py"])?;
    Ok(format!("studies on {}", CLUSTERS.join(", ")))
}

fn tested(python: &Path, files: &[&str]) -> Result<()> {
    let path = package()?;
    Step::new(python, ["-m", "pytest", "-q", "-p", "no:cacheprovider"])
        .args(files.iter().copied())
        .in_folder(&workspace::root().join("python"))
        .env("PYTHONPATH", path)
        .run()
        .context("a test of the package for Python fails, as is said above under its name")
}

/// A Python below the target folder that has the packages.
fn python(folder: &str, packages: &[&str]) -> Result<PathBuf> {
    let folder = workspace::root().join("target").join(folder);
    let python = folder.join("bin").join("python");
    if !Step::new(&python, ["-c", PROBE]).args(packages.iter().copied()).succeeds() {
        let make = Step::new("python3", ["-m", "venv"]).args([&folder]).within(INSTALL_LIMIT);
        if !make.succeeds() {
            apt::install("python3-venv")
                .and_then(|()| make.run())
                .context("tests of the package for Python need Python 3 with its module venv")?;
        }
        Step::new(&python, ["-m", "pip", "install", "--quiet"])
            .args(packages.iter().copied())
            .within(INSTALL_LIMIT)
            .run_silently()
            .context("packages cannot be installed from Python's package index")?;
    }
    Ok(python)
}

/// The package with its module beside it, from what the tests are built of: no wheel, which takes minutes.
///
/// # Returns
/// The folder to import it from.
fn package() -> Result<PathBuf> {
    // An example: with the whole workspace it is built of what the tests are built of.
    let build = ["build", "--workspace", "--profile", "test", "--example", "python_module"];
    let built = workspace::libraries(workspace::cargo(build))?;
    let module = built
        .iter()
        .find(|path| path.file_name().is_some_and(|name| name == "libpython_module.so"))
        .context("cargo has built no module for Python")?;
    let (from, to) = (
        workspace::root().join("python/surefoot"),
        workspace::root().join("target/python-package"),
    );
    let package = to.join("surefoot");
    std::fs::create_dir_all(&package).with_context(|| format!("{}", package.display()))?;
    for entry in std::fs::read_dir(&from).with_context(|| format!("{}", from.display()))? {
        let path = entry?.path();
        if let Some(name) = path.file_name().filter(|_| path.is_file()) {
            std::fs::copy(&path, package.join(name))?;
        }
    }
    std::fs::copy(module, package.join("_surefoot.abi3.so"))
        .with_context(|| format!("{} cannot be copied", module.display()))?;
    Ok(to)
}

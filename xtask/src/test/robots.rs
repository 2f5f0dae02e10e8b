//! Robots of other projects: imported, and their dynamics against Pinocchio and MuJoCo.

use crate::step::Step;
use crate::{apt, workspace};
use anyhow::{Context, Result};
use std::path::PathBuf;

/// Robot files, and the tool that MJCF models are held against.
const PACKAGES: [&str; 4] =
    ["example-robot-data==6.0.0", "dm_control==1.0.50", "gymnasium==1.4.0", "mujoco==4.0.0"];
/// Seconds for the download.
const INSTALL_LIMIT: u64 = 1200;

/// Succeeds where a Python has all packages in these versions, and prints where their files are.
const PROBE: &str = "import importlib.metadata as m, sys, sysconfig
for package in sys.argv[1:]:
    name, version = package.split('==')
    assert m.version(name) == version, package
print(sysconfig.get_path('purelib'))";

/// Where they are.
pub struct Files {
    python: PathBuf,
    folder: String,
}

impl Files {
    /// Tells tests where to find them.
    pub fn given_to(&self, tests: Step) -> Step {
        tests
            .env("SUREFOOT_ROBOT_PYTHON", &self.python)
            .env("SUREFOOT_ROBOT_FILES", self.folder.as_str())
    }
}

/// Installs what is missing into a folder of its own below the target folder.
pub fn files() -> Result<Files> {
    let folder = workspace::root().join("target").join("robots").join("python");
    let python = folder.join("bin").join("python");
    let probe = Step::new(&python, ["-c", PROBE]).args(PACKAGES);
    if !probe.succeeds() {
        let make = Step::new("python3", ["-m", "venv"]).args([&folder]).within(INSTALL_LIMIT);
        if !make.succeeds() {
            apt::install("python3-venv")
                .and_then(|()| make.run())
                .context("robot files come as Python packages: Python 3 with its module venv is needed for them")?;
        }
        Step::new(&python, ["-m", "pip", "install", "--quiet"])
            .args(PACKAGES)
            .within(INSTALL_LIMIT)
            .run_silently()
            .context(
                "the packages of robot files cannot be installed from Python's package index",
            )?;
    }
    let folder = probe.read()?.trim().to_owned();
    Ok(Files { python, folder })
}

/// Runs the tests, with what is missing installed.
pub fn run() -> Result<String> {
    files()?
        .given_to(workspace::ignored_tests("real_robots"))
        .run()
        .context("a robot of another project fails, as is said above under its name")?;
    Ok(format!("robots of {}", PACKAGES.join(", ")))
}

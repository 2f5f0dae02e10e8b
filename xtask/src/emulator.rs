//! QEMU's emulator for Arm, where this machine lacks it.

use crate::step::Step;
use crate::{apt, workspace};
use anyhow::{Context, Result};
use std::path::{Path, PathBuf};

const PROGRAM: &str = "qemu-system-arm";

/// Where a copy of one's own is put: the simulator looks there first.
fn own_copy() -> PathBuf {
    workspace::root().join("target/qemu").join(PROGRAM)
}

/// # Returns
/// The version of the emulator that this machine has, or is given: installed, or, where that would remove
/// another package, unpacked beside the images.
pub fn provide() -> Result<String> {
    let own = Step::new(own_copy(), ["--version"]);
    let installed = Step::new(PROGRAM, ["--version"]);
    let version = if own.succeeds() {
        own
    } else if installed.succeeds() {
        installed
    } else if let Err(error) = apt::install(PROGRAM) {
        eprintln!("  {error:#}\n  so it is unpacked for this workspace alone");
        unpack().context(
            "the firmware runs in QEMU's emulator for Arm, which is not installed and cannot be",
        )?;
        own
    } else {
        installed
    };
    Ok(version.read()?.lines().next().unwrap_or_default().to_owned())
}

fn unpack() -> Result<()> {
    let own = own_copy();
    let folder = own.parent().context("a folder")?;
    let root = folder.join("root");
    apt::unpack(PROGRAM, &root)?;
    std::fs::write(&own, script()).with_context(|| format!("cannot write {}", own.display()))?;
    make_executable(&own)
}

/// Starts the program with the libraries that were unpacked with it.
fn script() -> String {
    format!(
        "#!/bin/sh\n\
         root=$(dirname \"$0\")/root\n\
         LD_LIBRARY_PATH=$(echo \"$root\"/usr/lib/*-linux-gnu):$(echo \"$root\"/lib/*-linux-gnu)\n\
         export LD_LIBRARY_PATH\n\
         exec \"$root/usr/bin/{PROGRAM}\" -L \"$root/usr/share/qemu\" \"$@\"\n"
    )
}

fn make_executable(file: &Path) -> Result<()> {
    Step::new("chmod", ["+x".into(), file.as_os_str().to_owned()]).run_silently()
}

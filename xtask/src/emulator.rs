//! QEMU's emulators, where this machine lacks them.

use crate::step::Step;
use crate::{apt, workspace};
use anyhow::{Context, Result};
use std::fs;
use std::path::{Path, PathBuf};

/// An emulator.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Emulator {
    /// Of Arm's chips.
    Arm,
    /// Of 32-bit RISC-V's.
    RiscV,
}

impl Emulator {
    fn program(self) -> &'static str {
        match self {
            Self::Arm => "qemu-system-arm",
            Self::RiscV => "qemu-system-riscv32",
        }
    }

    /// Of Debian.
    fn package(self) -> &'static str {
        match self {
            Self::Arm => "qemu-system-arm",
            Self::RiscV => "qemu-system-misc",
        }
    }

    /// Where a copy of one's own is put: the simulator looks there first.
    fn own_copy(self) -> PathBuf {
        workspace::root().join("target/qemu").join(self.program())
    }
}

/// # Returns
/// The version of the emulator that this machine has, or is given: installed, or, where that would remove
/// another package, unpacked beside the images.
pub fn provide(emulator: Emulator) -> Result<String> {
    let (program, package) = (emulator.program(), emulator.package());
    let own = Step::new(emulator.own_copy(), ["--version"]);
    let installed = Step::new(program, ["--version"]);
    let version = if own.succeeds() {
        own
    } else if installed.succeeds() {
        installed
    } else if let Err(error) = apt::install(package) {
        eprintln!("  {error:#}\n  so it is unpacked for this workspace alone");
        unpack(emulator).with_context(|| {
            format!("the firmware runs in QEMU's {program}, which is not installed and cannot be")
        })?;
        own
    } else {
        installed
    };
    Ok(version.read()?.lines().next().unwrap_or_default().to_owned())
}

fn unpack(emulator: Emulator) -> Result<()> {
    let own = emulator.own_copy();
    let folder = own.parent().context("a folder")?;
    let root = folder.join("root");
    apt::unpack(emulator.package(), &root)?;
    // The package has the emulators of twenty other architectures.
    for program in fs::read_dir(root.join("usr/bin"))? {
        let program = program?.path();
        let is_wanted = [Emulator::Arm, Emulator::RiscV]
            .into_iter()
            .any(|wanted| program.file_name().is_some_and(|name| name == wanted.program()));
        if !is_wanted {
            fs::remove_file(&program)
                .with_context(|| format!("cannot remove {}", program.display()))?;
        }
    }
    let script = script(emulator.program());
    fs::write(&own, script).with_context(|| format!("cannot write {}", own.display()))?;
    make_executable(&own)
}

/// Starts the program with the libraries that were unpacked with it.
fn script(program: &str) -> String {
    format!(
        "#!/bin/sh\n\
         root=$(dirname \"$0\")/root\n\
         LD_LIBRARY_PATH=$(echo \"$root\"/usr/lib/*-linux-gnu):$(echo \"$root\"/lib/*-linux-gnu)\n\
         export LD_LIBRARY_PATH\n\
         exec \"$root/usr/bin/{program}\" -L \"$root/usr/share/qemu\" \"$@\"\n"
    )
}

fn make_executable(file: &Path) -> Result<()> {
    Step::new("chmod", ["+x".into(), file.as_os_str().to_owned()]).run_silently()
}

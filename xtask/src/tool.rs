//! A program of one of Debian's packages: installed, or, where that would remove another package, unpacked for this
//! workspace alone.

use crate::step::Step;
use crate::{apt, workspace};
use anyhow::{Context, Result};
use std::fs;
use std::path::{Path, PathBuf};

/// A program.
#[derive(Clone, Copy)]
pub struct Tool {
    /// Its name.
    pub program: &'static str,
    /// Debian's.
    pub package: &'static str,
    /// Below the target folder, where it is unpacked.
    pub folder: &'static str,
    /// What a program that is not where it expects to be must be told, for a shell: `$root` is its root.
    pub arguments: &'static str,
    /// Programs of the folder that stay, by their beginnings; a package may have many more.
    pub kept: &'static [&'static str],
}

impl Tool {
    /// Where a copy of one's own is put.
    fn own_copy(&self) -> PathBuf {
        workspace::root().join("target").join(self.folder).join(self.program)
    }

    /// Installs it where it is missing.
    ///
    /// # Returns
    /// What starts it.
    pub fn provide(&self) -> Result<PathBuf> {
        let (own, installed) = (self.own_copy(), PathBuf::from(self.program));
        let works = |path: &Path| Step::new(path, ["--version"]).succeeds();
        if works(&own) {
            return Ok(own);
        }
        if works(&installed) {
            return Ok(installed);
        }
        if let Err(error) = apt::install(self.package) {
            eprintln!("  {error:#}\n  so it is unpacked for this workspace alone");
            self.unpack()
                .with_context(|| format!("{} is not installed, and cannot be", self.program))?;
            return Ok(own);
        }
        Ok(installed)
    }

    fn unpack(&self) -> Result<()> {
        let own = self.own_copy();
        let root = own.parent().context("a folder")?.join("root");
        apt::unpack(self.package, &root)?;
        for program in fs::read_dir(root.join("usr/bin"))? {
            let program = program?;
            let name = program.file_name().to_string_lossy().into_owned();
            if !self.kept.iter().any(|kept| name.starts_with(kept)) {
                fs::remove_file(program.path())
                    .with_context(|| format!("cannot remove {}", program.path().display()))?;
            }
        }
        fs::write(&own, self.script())
            .with_context(|| format!("cannot write {}", own.display()))?;
        Step::new("chmod", ["+x".into(), own.into_os_string()]).run_silently()
    }

    /// Starts the program with the libraries that were unpacked with it.
    fn script(&self) -> String {
        let Self { program, arguments, .. } = self;
        format!(
            "#!/bin/sh\n\
             root=$(dirname \"$0\")/root\n\
             LD_LIBRARY_PATH=$(echo \"$root\"/usr/lib/*-linux-gnu):$(echo \"$root\"/lib/*-linux-gnu)\n\
             export LD_LIBRARY_PATH\n\
             exec \"$root/usr/bin/{program}\" {arguments} \"$@\"\n"
        )
    }
}

//! `cargo xtask firmware`: the firmware's images.

use crate::arm_toolchain::ArmToolchain;
use crate::{emulator, workspace};
use anyhow::{Context, Result};
use std::path::PathBuf;

const PACKAGE: &str = "surefoot-firmware";

/// An image of the firmware.
#[derive(Clone, Copy)]
pub enum Variant {
    /// For a board.
    Board,
    /// For the emulator, with every message logged.
    Emulation,
    /// For the emulator, with no message logged.
    Silent,
}

impl Variant {
    /// All images.
    pub const ALL: [Self; 3] = [Self::Board, Self::Emulation, Self::Silent];

    fn name(self) -> &'static str {
        match self {
            Self::Board => "board",
            Self::Emulation => "emulation",
            Self::Silent => "silent",
        }
    }

    /// Where the image is put: the simulator and its tests look there.
    pub fn path(self) -> PathBuf {
        let folder = workspace::root().join("target/firmware");
        folder.join(format!("{PACKAGE}-{}.elf", self.name()))
    }

    fn build(self, arm: &ArmToolchain) -> Result<()> {
        let (features, log): (&[&str], _) = match self {
            Self::Board => (&[], "info"),
            Self::Emulation => (&["--features", "emulation"], "debug"),
            Self::Silent => (&["--features", "emulation"], "off"),
        };
        let cargo = arm.cargo("build").args(["--release", "--package", PACKAGE]);
        let cargo = cargo.args(features.iter().copied()).env("DEFMT_LOG", log);
        let built = workspace::executables(cargo, [])?;
        let built = built.first().context("cargo has built no image")?;
        let path = self.path();
        std::fs::create_dir_all(path.parent().context("a folder")?)?;
        std::fs::copy(built, &path).with_context(|| format!("cannot write {}", path.display()))?;
        Ok(())
    }
}

/// Builds all images.
pub fn build(arm: &ArmToolchain) -> Result<()> {
    Variant::ALL.into_iter().try_for_each(|variant| variant.build(arm))
}

/// Builds all images, and says where they are.
pub fn run() -> Result<()> {
    emulator::provide()?;
    build(&ArmToolchain::provide()?)?;
    for variant in Variant::ALL {
        println!("{}", variant.path().display());
    }
    Ok(())
}

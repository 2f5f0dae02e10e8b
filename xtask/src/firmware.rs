//! `cargo xtask firmware`: the firmware's images, of one robot.

use crate::emulator;
use crate::tool::Tool;
use crate::toolchain::{TARGET, Toolchain};
use crate::workspace;
use anyhow::{Context, Result, ensure};
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};

const PACKAGE: &str = "surefoot-firmware";

/// The robot of the text.
const OF_THE_TEXT: &str = "firmware/robots/biped.rs";

/// Of which robot.
#[derive(Args)]
pub struct Options {
    /// The robot.rs that `surefoot import` wrote; the robot of the text unless said.
    #[arg(long, value_name = "DIR/robot.rs")]
    robot: Option<PathBuf>,
    /// Images that walk, below the robot's name with `-walks`.
    #[arg(long)]
    walks: bool,
    /// Images that estimate the state and observe disturbances, below the robot's name with `-estimates`.
    #[arg(long)]
    estimates: bool,
    /// Only this image (may be given several times); those of the reference board's chip unless said.
    #[arg(long, value_name = "IMAGE")]
    image: Vec<Variant>,
}

/// A robot that firmware is built for.
pub struct Robot {
    /// Its robot.rs.
    source: PathBuf,
    /// Of the folder of its images.
    name: String,
    /// Whether the images walk.
    walks: bool,
    /// Whether they estimate the state.
    estimates: bool,
    legs: Option<usize>,
}

impl Robot {
    /// The robot of the text.
    pub fn of_the_text() -> Result<Self> {
        Self::of_file(&workspace::root().join(OF_THE_TEXT))
    }

    /// As a file describes it.
    pub fn of_file(file: &Path) -> Result<Self> {
        const EXPECTED: &str = "expected the robot.rs that `surefoot import` writes";
        let source = file
            .canonicalize()
            .with_context(|| format!("{} cannot be read; {EXPECTED}", file.display()))?;
        let text = std::fs::read_to_string(&source)
            .with_context(|| format!("{} cannot be read; {EXPECTED}", file.display()))?;
        let name = name(&text).with_context(|| {
            format!(
                "{} describes no robot that the firmware balances; {EXPECTED} beside a stand.toml \
                 (where it writes none, it says why)",
                file.display()
            )
        })?;
        let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_.".contains(c);
        ensure!(
            name.chars().all(is_plain) && !name.starts_with('.'),
            "{}: the name {name:?} is none for a folder; {EXPECTED}",
            file.display()
        );
        let (name, legs) = (name.to_owned(), legs(&text));
        Ok(Self { name, walks: false, estimates: false, legs, source })
    }

    /// The same, in images that walk.
    pub fn walking(self) -> Self {
        Self { walks: true, ..self }
    }

    /// The same, in images that estimate the state.
    pub fn estimating(self) -> Self {
        Self { estimates: true, ..self }
    }

    /// Its robot.rs.
    pub fn source(&self) -> &Path {
        &self.source
    }

    /// Of the folder of what is built for it.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// How many legs of six joints it has, where all that moves are such.
    pub fn legs(&self) -> Option<usize> {
        self.legs
    }
}

/// Of the folder of images, as a robot.rs says it.
fn name(text: &str) -> Option<&str> {
    let (_, module) = text.split_once("\npub mod firmware {")?;
    let (_, name) = module.split_once("pub const NAME: &str = \"")?;
    let (name, _) = name.split_once('"')?;
    Some(name).filter(|name| !name.is_empty())
}

/// Its number of legs, likewise.
fn legs(text: &str) -> Option<usize> {
    let (_, module) = text.split_once("\npub mod firmware {")?;
    let (_, legs) = module.split_once("pub const LEGS: usize = ")?;
    legs.split_once(';')?.0.parse().ok()
}

/// An image of the firmware.
#[derive(Clone, Copy, ValueEnum)]
pub enum Variant {
    /// For a board.
    Board,
    /// For the emulator, with every message logged.
    Emulation,
    /// For the emulator, with no message logged.
    Silent,
    /// For QEMU's board with a Cortex-M33.
    #[value(name = "mps2-an505")]
    Mps2An505,
    /// For QEMU's board with a Cortex-M7.
    #[value(name = "mps2-an500")]
    Mps2An500,
    /// For QEMU's board with an RV32IMAFC.
    #[value(name = "virt-rv32")]
    VirtRv32,
}

impl Variant {
    /// Of the reference board's chip.
    pub const REFERENCE: [Self; 3] = [Self::Board, Self::Emulation, Self::Silent];
    /// Of other chips.
    pub const OTHERS: [Self; 3] = [Self::Mps2An505, Self::Mps2An500, Self::VirtRv32];

    /// Of its file.
    pub fn name(self) -> &'static str {
        match self {
            Self::Board => "board",
            Self::Emulation => "emulation",
            Self::Silent => "silent",
            Self::Mps2An505 => "mps2-an505",
            Self::Mps2An500 => "mps2-an500",
            Self::VirtRv32 => "virt-rv32",
        }
    }

    /// As rustc calls it.
    pub fn target(self) -> &'static str {
        match self {
            Self::Mps2An505 => "thumbv8m.main-none-eabihf",
            Self::VirtRv32 => "riscv32imafc-unknown-none-elf",
            _ => TARGET,
        }
    }

    fn emulator(self) -> Tool {
        match self {
            Self::VirtRv32 => emulator::RISC_V,
            _ => emulator::ARM,
        }
    }

    /// Where a robot's image is put: the simulator and its tests look there.
    pub fn path(self, robot: &Robot) -> PathBuf {
        let walks = if robot.walks { "-walks" } else { "" };
        let estimates = if robot.estimates { "-estimates" } else { "" };
        let folder = format!("{}{walks}{estimates}", robot.name);
        let folder = workspace::root().join("target/firmware").join(folder);
        folder.join(format!("{}.elf", self.name()))
    }

    fn build(self, toolchain: &Toolchain, robot: &Robot) -> Result<()> {
        let (features, log): (&[&str], _) = match self {
            Self::Board => (&[], "info"),
            Self::Emulation => (&["--features", "emulation"], "debug"),
            Self::Silent => (&["--features", "emulation"], "off"),
            _ => (&["--no-default-features", "--features", self.name()], "info"),
        };
        let mut cargo = toolchain.cargo("build");
        if let Self::Mps2An500 = self {
            // The triple is the Cortex-M4F's too. A folder of its own keeps both sets of libraries.
            let folder = workspace::root().join("target/cortex-m7");
            cargo = cargo
                .env(toolchain.setting("RUSTFLAGS"), "-C target-cpu=cortex-m7")
                .args(["--target-dir".into(), folder.into_os_string()]);
        }
        let cargo = cargo.args(["--release", "--package", PACKAGE]);
        let cargo = cargo.args(features.iter().copied()).env("DEFMT_LOG", log);
        let mut cargo = cargo.env("SUREFOOT_ROBOT", &robot.source);
        if robot.walks {
            cargo = cargo.env("SUREFOOT_WALKS", "1");
        }
        if robot.estimates {
            cargo = cargo.env("SUREFOOT_ESTIMATES", "1");
        }
        let built = workspace::executables(cargo, [])?;
        let built = built.first().context("cargo has built no image")?;
        let path = self.path(robot);
        std::fs::create_dir_all(path.parent().context("a folder")?)?;
        std::fs::copy(built, &path).with_context(|| format!("cannot write {}", path.display()))?;
        Ok(())
    }
}

/// Builds all images of a robot for the reference board's chip.
pub fn build(arm: &Toolchain, robot: &Robot) -> Result<()> {
    Variant::REFERENCE.into_iter().try_for_each(|variant| variant.build(arm, robot))
}

/// Builds a robot's images for other chips, with what is missing for that installed, and for running them.
pub fn build_for_other_chips(robot: &Robot) -> Result<()> {
    build_images(&Variant::OTHERS, robot)
}

/// Builds the image for the emulator.
///
/// # Returns
/// Where it is.
pub fn build_emulation(robot: &Robot) -> Result<PathBuf> {
    build_images(&[Variant::Emulation], robot)?;
    Ok(Variant::Emulation.path(robot))
}

fn build_images(images: &[Variant], robot: &Robot) -> Result<()> {
    for emulator in [emulator::ARM, emulator::RISC_V] {
        if images.iter().any(|image| image.emulator().program == emulator.program) {
            emulator::provide(emulator)?;
        }
    }
    images.iter().try_for_each(|image| image.build(&Toolchain::provide(image.target())?, robot))
}

/// The robot of the text in images that estimate the state, and in ones that walk.
pub fn variants() -> Result<[Robot; 2]> {
    Ok([Robot::of_the_text()?.estimating(), Robot::of_the_text()?.walking()])
}

/// Builds these for the emulator.
pub fn build_variants(arm: &Toolchain) -> Result<()> {
    variants()?.iter().try_for_each(|robot| Variant::Emulation.build(arm, robot))
}

/// Builds all images, and says where they are.
pub fn run(options: &Options) -> Result<()> {
    let robot = match &options.robot {
        Some(file) => Robot::of_file(file)?,
        None => Robot::of_the_text()?,
    };
    let robot = if options.walks { robot.walking() } else { robot };
    let robot = if options.estimates { robot.estimating() } else { robot };
    let images = if options.image.is_empty() { &Variant::REFERENCE[..] } else { &options.image };
    build_images(images, &robot)?;
    for variant in images {
        println!("{}", variant.path(&robot).display());
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_robot_of_the_text_has_a_name() {
        let robot = Robot::of_the_text().expect("a robot");
        assert_eq!(robot.name, "biped");
        assert!(Variant::Board.path(&robot).ends_with("target/firmware/biped/board.elf"));
    }

    #[test]
    fn what_describes_no_robot_to_firmware_is_refused() {
        let refused = |path: &str| {
            let error = Robot::of_file(&workspace::root().join(path)).err().expect("refused");
            format!("{error:#}")
        };
        assert!(refused("no-such-robot.rs").contains("surefoot import"));
        assert!(refused("xtask/src/main.rs").contains("describes no robot"));
        assert_eq!(name("\npub mod firmware {\npub const NAME: &str = \"\";"), None);
    }
}

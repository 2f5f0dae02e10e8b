//! QEMU's emulators, where this machine lacks them.

use crate::step::Step;
use crate::tool::Tool;
use anyhow::{Context, Result};

/// Of Arm's chips.
pub const ARM: Tool = emulator("qemu-system-arm", "qemu-system-arm");
/// Of 32-bit RISC-V's. Its package has those of twenty other architectures.
pub const RISC_V: Tool = emulator("qemu-system-riscv32", "qemu-system-misc");

/// The simulator looks in that folder first.
const fn emulator(program: &'static str, package: &'static str) -> Tool {
    let kept = &["qemu-system-arm", "qemu-system-riscv32"];
    Tool { program, package, folder: "qemu", arguments: "-L \"$root/usr/share/qemu\"", kept }
}

/// # Returns
/// The version of the emulator that this machine has, or is given.
pub fn provide(emulator: Tool) -> Result<String> {
    let program = emulator
        .provide()
        .with_context(|| format!("the firmware runs in QEMU's {}", emulator.program))?;
    let version = Step::new(program, ["--version"]).read()?;
    Ok(version.lines().next().unwrap_or_default().to_owned())
}

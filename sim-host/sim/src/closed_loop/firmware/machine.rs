//! Machines of QEMU that the firmware has images for.

use std::path::Path;

/// Folder of the copies that `cargo xtask firmware` unpacks where they cannot be installed.
const OWN_COPIES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../target/qemu");

/// A machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Machine {
    /// As QEMU calls it.
    name: &'static str,
    /// Of QEMU.
    program: &'static str,
    /// More of QEMU's arguments.
    arguments: &'static [&'static str],
    /// An instruction takes 2 to this power of ns, so that the firmware's counter tells instructions exactly.
    shift: &'static str,
    /// Of the firmware: a robot's folder has `IMAGE.elf`.
    image: &'static str,
    /// Its core.
    core: &'static str,
}

impl Machine {
    /// The reference board's: an STM32F405, Cortex-M4F.
    pub const REFERENCE: Self = Self {
        name: "netduinoplus2",
        program: "qemu-system-arm",
        arguments: &[],
        shift: "shift=4",
        image: "emulation",
        core: "Cortex-M4F",
    };

    /// All others.
    pub const OTHERS: [Self; 3] = [
        Self {
            name: "mps2-an505",
            program: "qemu-system-arm",
            arguments: &[],
            shift: "shift=7",
            image: "mps2-an505",
            core: "Cortex-M33",
        },
        Self {
            name: "mps2-an500",
            program: "qemu-system-arm",
            arguments: &[],
            shift: "shift=7",
            image: "mps2-an500",
            core: "Cortex-M7",
        },
        Self {
            name: "virt",
            program: "qemu-system-riscv32",
            // An RV32IMAFC with M-mode alone, and nothing that starts before the image.
            arguments: &["-cpu", "rv32,d=false", "-bios", "none"],
            shift: "shift=0",
            image: "virt-rv32",
            core: "RV32IMAFC",
        },
    ];

    /// QEMU's program: the workspace's own copy, if there is one, or the machine's.
    pub fn program(&self) -> String {
        let own = Path::new(OWN_COPIES).join(self.program);
        if own.exists() { own.display().to_string() } else { self.program.to_owned() }
    }

    /// Which machine, how fast, and that the image may open files of its folder.
    pub fn arguments(&self) -> impl Iterator<Item = &'static str> {
        let fixed = ["-machine", self.name, "-icount", self.shift];
        let semihosting = ["-semihosting-config", "enable=on,target=native"];
        fixed.into_iter().chain(semihosting).chain(self.arguments.iter().copied())
    }

    /// Name of its image's file, without its ending.
    pub fn image(&self) -> &'static str {
        self.image
    }

    /// What runs the image.
    pub fn core(&self) -> &'static str {
        self.core
    }
}

//! A program of C for a bare Cortex-M4F, built by CMake and run in QEMU, has the torques of the core, to the bit.

mod reference;

use reference::expected;
use std::env;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use surefoot_c::SUREFOOT_JOINTS;

/// Where `cargo xtask c` has put the library of the robot of the text.
const LIBRARY: &str = "../target/c/biped/thumbv7em-none-eabihf";

/// A program that `cargo xtask test` names.
fn program(name: &str) -> PathBuf {
    env::var_os(name).unwrap_or_else(|| panic!("{name} is not set")).into()
}

fn run(command: &mut Command) {
    let output = command.output().expect("starts");
    assert!(
        output.status.success(),
        "{command:?}: {} {}",
        String::from_utf8_lossy(&output.stdout),
        String::from_utf8_lossy(&output.stderr)
    );
}

#[test]
#[ignore = "needs a compiler of C for the target: `cargo xtask test --only c-library`"]
fn an_interrupt_of_c_has_the_bits_of_the_core() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).canonicalize().expect("a folder");
    let library = folder.join(LIBRARY).canonicalize().expect("`cargo xtask c` has built it");
    let build = Path::new(env!("CARGO_TARGET_TMPDIR")).join("bare-metal");
    let _ = std::fs::remove_dir_all(&build);
    let cmake = program("SUREFOOT_CMAKE");
    let setting = |name: &str, value: &Path| format!("-D{name}={}", value.display());
    run(Command::new(&cmake)
        .arg("-S")
        .arg(folder.join("examples"))
        .arg("-B")
        .arg(&build)
        .arg("--toolchain")
        .arg(folder.join("examples/bare_metal/arm-none-eabi.cmake"))
        .arg(setting("surefoot_DIR", &library))
        .arg(setting("CMAKE_C_COMPILER", &program("SUREFOOT_ARM_CC"))));
    run(Command::new(&cmake).arg("--build").arg(&build));
    let output = Command::new(program("SUREFOOT_QEMU_ARM"))
        .args(["-machine", "mps2-an386", "-nographic", "-monitor", "none", "-serial", "stdio"])
        .args(["-semihosting-config", "enable=on,target=native", "-icount", "shift=4"])
        .arg("-kernel")
        .arg(build.join("balance.elf"))
        .stdin(Stdio::null())
        .output()
        .expect("QEMU starts");
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{said} {}", String::from_utf8_lossy(&output.stderr));
    let given: Vec<u32> =
        said.split_whitespace().map(|word| u32::from_str_radix(word, 16).expect("bits")).collect();
    let wanted: Vec<u32> = expected().iter().map(|torque| torque.to_bits()).collect();
    assert_eq!(given.len(), 3 * SUREFOOT_JOINTS, "{said}");
    assert_eq!(given, wanted);
}

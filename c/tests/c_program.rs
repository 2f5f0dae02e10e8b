//! A program of C has the torques of the core, to the bit.

mod reference;

use reference::{POSITION, angles, expected};
use std::path::{Path, PathBuf};
use std::process::Command;
use surefoot_c::SUREFOOT_JOINTS;

/// Where `cargo xtask c` has put the library of the robot of the text.
fn library() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../target/c/biped/host")
}

/// `0x1.8p+1` as C writes it.
fn hexadecimal(word: &str) -> f32 {
    let (sign, rest) = word.strip_prefix('-').map_or((1.0, word), |rest| (-1.0, rest));
    let digits = rest.strip_prefix("0x").expect("a hexadecimal number");
    let (mantissa, power) = digits.split_once('p').expect("a power of two");
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let number = u64::from_str_radix(&format!("{whole}{fraction}"), 16).expect("digits");
    let power: i32 = power.parse().expect("an exponent");
    let scaled = number as f64 * 2.0_f64.powi(power - 4 * fraction.len() as i32);
    sign * scaled as f32
}

#[test]
#[ignore = "needs the library that `cargo xtask c` builds"]
fn a_program_of_c_has_the_bits_of_the_core() {
    let (library, folder) = (library(), Path::new(env!("CARGO_TARGET_TMPDIR")));
    let program = folder.join("balance");
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/balance.c");
    let compiled = Command::new("cc")
        .args(["-std=c11", "-Wall", "-Wextra", "-Werror", "-I"])
        .args([&library, &source, &library.join("libsurefoot_c.a")])
        .args(["-lm", "-lpthread", "-ldl", "-o"])
        .arg(&program)
        .status()
        .expect("a compiler for C");
    assert!(compiled.success());
    let words = POSITION.iter().chain(&angles()).map(f32::to_string).collect::<Vec<_>>();
    let output = Command::new(&program).args(&words).output().expect("runs");
    let said = String::from_utf8(output.stdout).expect("text");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let given: Vec<f32> = said.split_whitespace().map(hexadecimal).collect();
    let wanted = expected();
    assert_eq!(given.len(), 3 * SUREFOOT_JOINTS);
    for (number, (given, wanted)) in given.iter().zip(&wanted).enumerate() {
        assert_eq!(given.to_bits(), wanted.to_bits(), "torque {number}: {given} {wanted}");
    }
    assert!(wanted.iter().any(|torque| torque.abs() > 10.0));
    // What is no robot is refused.
    assert_eq!(Command::new(&program).status().expect("runs").code(), Some(2));
}

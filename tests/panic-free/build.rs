//! Links the images with cortex-m-rt's script and the board's memory map. On the host there is
//! nothing to say.

use std::env;
use std::fs;
use std::path::Path;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    if env::var("CARGO_CFG_TARGET_OS").as_deref() != Ok("none") {
        return;
    }
    let package = env::var("CARGO_MANIFEST_DIR").expect("cargo sets it for build scripts");
    let memory = Path::new(&package).join("../../memory.x");
    println!("cargo::rerun-if-changed={}", memory.display());
    let out = env::var("OUT_DIR").expect("cargo sets it for build scripts");
    fs::copy(&memory, Path::new(&out).join("memory.x")).expect("cargo's folder can be written");
    println!("cargo::rustc-link-search={out}");
    println!("cargo::rustc-link-arg-bins=-Tlink.x");
    // No gap of a page between headers and flash: the image starts where the flash does.
    println!("cargo::rustc-link-arg-bins=--nmagic");
    // Kept so that the check can say from where a panicking function is called.
    println!("cargo::rustc-link-arg-bins=--emit-relocs");
}

//! Links with cortex-m-rt's script, defmt's table of messages and the board's memory map. On the host
//! there is nothing to say.

use std::env;
use std::path::Path;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    if env::var("CARGO_CFG_TARGET_OS").as_deref() != Ok("none") {
        return;
    }
    let package = env::var("CARGO_MANIFEST_DIR").expect("cargo sets it for build scripts");
    let workspace = Path::new(&package).join("..");
    println!("cargo::rerun-if-changed={}", workspace.join("memory.x").display());
    println!("cargo::rustc-link-search={}", workspace.display());
    for argument in ["-Tlink.x", "-Tdefmt.x", "--nmagic", "--emit-relocs"] {
        println!("cargo::rustc-link-arg-bins={argument}");
    }
}

//! Tells the linker where memory.x lies, for the target only.

fn main() {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
    println!("cargo:rerun-if-changed={root}/memory.x");
    if std::env::var("CARGO_CFG_TARGET_OS").is_ok_and(|os| os == "none") {
        println!("cargo:rustc-link-search={root}");
        println!("cargo:rustc-link-arg-bins=-Tlink.x");
    }
}

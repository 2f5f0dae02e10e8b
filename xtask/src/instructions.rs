//! `cargo xtask instructions`: instructions per call, by callgrind. They repeat to the digit for one
//! compiler, whatever else the machine does.

use crate::shell::{cargo, need, output, root, run};
use anyhow::{Context, Result};
use clap::Parser;
use std::path::Path;
use std::process::Command;

/// Options of `instructions`.
#[derive(Debug, Parser)]
pub struct Options {
    /// Only workloads whose name (algorithm/model/scalar) contains this
    #[arg(long, default_value = "")]
    only: String,
    /// One JSON document instead of text
    #[arg(long)]
    json: bool,
}

/// The difference between two runs leaves start-up out.
const FEW: u32 = 50;
const MANY: u32 = 150;

/// Counts and prints.
///
/// # Errors
/// If valgrind is missing and cannot be installed, or a run fails.
pub fn instructions(options: &Options) -> Result<()> {
    need("valgrind", "valgrind")?;
    let build = ["build", "--release", "--package", "surefoot-tests", "--example", "instructions"];
    run(cargo().args(build))?;
    let program = root().join("target/release/examples/instructions");
    let names = output(&mut Command::new(&program))?;
    let mut counts = serde_json::Map::new();
    for name in names.lines().filter(|name| name.contains(&options.only)) {
        let per_call = (collected(&program, name, MANY)? - collected(&program, name, FEW)?)
            / u64::from(MANY - FEW);
        if options.json {
            counts.insert(name.to_owned(), per_call.into());
        } else {
            println!("{per_call:>9}  {name}");
        }
    }
    if options.json {
        println!("{:#}", serde_json::Value::Object(counts));
    }
    Ok(())
}

/// Instructions of a whole run.
fn collected(program: &Path, name: &str, calls: u32) -> Result<u64> {
    let result = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(program)
        .args([name, &calls.to_string()])
        .output()
        .context("cannot start valgrind")?;
    let said = String::from_utf8_lossy(&result.stderr);
    said.lines()
        .find_map(|line| line.split_once("Collected : ")?.1.trim().parse().ok())
        .with_context(|| format!("valgrind counted nothing for {name}:\n{said}"))
}

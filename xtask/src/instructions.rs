//! `cargo xtask instructions`: how many instructions one call of an algorithm takes on this
//! machine's kind of processor.
//!
//! Unlike seconds, the count is the same on every run and under any load, so that a difference of
//! one in a thousand between two versions of the source is a fact. It is made from two runs of a
//! small program under callgrind, one of which makes twice the calls of the other: what they do not
//! have in common are the calls.

use crate::step::Step;
use crate::{apt, workspace};
use anyhow::{Context, Result, bail, ensure};
use clap::Args;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Calls in the shorter run. Every call is like the others, so that a few will do.
const CALLS: u64 = 10;

/// Seconds for one run; the longest takes two.
const RUN_LIMIT: u64 = 120;

/// What to count, and how to say it.
#[derive(Args)]
pub struct Options {
    /// Count only the workloads with all of these words among algorithm, model and scalar.
    words: Vec<String>,
    /// Print one JSON document on stdout, and nothing else.
    #[arg(long)]
    json: bool,
}

/// All counts, as `--json` prints them.
#[derive(Serialize)]
struct Report {
    /// Version of valgrind, whose callgrind counts.
    tool: String,
    /// Compiler and processor's kind, which the counts belong to.
    compiler: String,
    target: String,
    rows: Vec<Row>,
}

#[derive(Serialize)]
struct Row {
    algorithm: String,
    model: String,
    scalar: String,
    /// Instructions of one call.
    instructions: u64,
}

/// Builds the program, counts, and prints.
pub fn run(options: &Options) -> Result<()> {
    let tool = provide_valgrind()?;
    let program = build()?;
    let rustc = workspace::rustc(["--version", "--verbose"]).read()?;
    let of_rustc = |field: &str| rustc.lines().find_map(|line| line.strip_prefix(field));
    let mut report = Report {
        tool,
        compiler: rustc.lines().next().unwrap_or_default().to_owned(),
        target: of_rustc("host: ").unwrap_or_default().to_owned(),
        rows: Vec::new(),
    };
    let listing = Step::new(&program, [""; 0]).read()?;
    for name in listing.lines() {
        let parts: Vec<&str> = name.split('/').collect();
        let [algorithm, model, scalar] = parts[..] else {
            bail!("the workload {name} is not named algorithm/model/scalar")
        };
        if !options.words.iter().all(|word| parts.contains(&word.as_str())) {
            continue;
        }
        let instructions = count(&program, name)?;
        eprintln!("  {name}: {instructions}");
        let [algorithm, model, scalar] = [algorithm, model, scalar].map(str::to_owned);
        report.rows.push(Row { algorithm, model, scalar, instructions });
    }
    ensure!(
        !report.rows.is_empty(),
        "no workload has all the words `{}`. These are the workloads:\n{listing}",
        options.words.join(" ")
    );
    if options.json {
        println!("{}", serde_json::to_string_pretty(&report)?);
    } else {
        print(&report);
    }
    Ok(())
}

/// Instructions of one call.
fn count(program: &Path, workload: &str) -> Result<u64> {
    let counts = program.with_extension("callgrind");
    let total = |calls: u64| -> Result<u64> {
        Step::new("valgrind", ["--quiet", "--tool=callgrind"])
            .args([format!("--callgrind-out-file={}", counts.display())])
            .args([program])
            .args([workload, &calls.to_string()])
            .within(RUN_LIMIT)
            .read()?;
        let file = std::fs::read_to_string(&counts)
            .with_context(|| format!("callgrind has not written {}", counts.display()))?;
        read_total(&file).with_context(|| format!("{} has no total", counts.display()))
    };
    let (once, twice) = (total(CALLS)?, total(2 * CALLS)?);
    Ok(twice.saturating_sub(once) / CALLS)
}

/// The number of instructions in a file of callgrind's.
fn read_total(file: &str) -> Option<u64> {
    file.lines().rev().find_map(|line| line.strip_prefix("totals: "))?.trim().parse().ok()
}

/// # Returns
/// The version of the valgrind that this machine has, or is given.
fn provide_valgrind() -> Result<String> {
    let version = Step::new("valgrind", ["--version"]);
    if !version.succeeds() {
        apt::install("valgrind").context(
            "callgrind, which counts the instructions, comes with valgrind, which is not installed \
             and cannot be",
        )?;
    }
    version.read()
}

/// # Returns
/// The path of the program whose instructions are counted.
fn build() -> Result<PathBuf> {
    let build = ["build", "--release", "--package", "surefoot-tests", "--example", "instructions"];
    let executables = workspace::executables(workspace::cargo(build), [])?;
    executables.into_iter().next().context("cargo has built no program")
}

fn print(report: &Report) {
    println!("instructions per call · {} · {} · {}", report.target, report.compiler, report.tool);
    println!("{:<24} {:<12} {:<6} {:>12}", "algorithm", "model", "scalar", "instructions");
    for Row { algorithm, model, scalar, instructions } in &report.rows {
        println!("{algorithm:<24} {model:<12} {scalar:<6} {instructions:>12}");
    }
}

#[cfg(test)]
mod tests {
    use super::read_total;

    #[test]
    fn the_total_is_read_from_the_end_of_the_file() {
        let file = "# callgrind format\nsummary: 7\n\nfn=(0)\n1 2\n\ntotals: 439958\n";
        assert_eq!(read_total(file), Some(439_958));
        assert_eq!(read_total("summary: 7\n"), None);
    }
}

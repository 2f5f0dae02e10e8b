//! `cargo xtask instructions`: how many instructions one call of an algorithm takes on this
//! machine's kind of processor.
//!
//! Unlike seconds, the count is the same on every run and under any load, so that a difference of
//! one in a thousand between two versions of the source is a fact. It is made from two runs of a
//! small program under callgrind, one of which makes twice the calls of the other: what they do not
//! have in common are the calls.

mod callgrind;
mod unused;

pub use unused::nothing_unused_runs;

use crate::step::Step;
use crate::{apt, workspace};
use anyhow::{Context, Result, bail, ensure};
use callgrind::Counts;
use clap::Args;
use serde::Serialize;

/// What to count, and how to say it.
#[derive(Args)]
pub struct Options {
    /// Count only the workloads with all of these words among algorithm, model and scalar.
    words: Vec<String>,
    /// Check instead that steps of scenes without a feature run none of its code.
    #[arg(long, conflicts_with_all = ["words", "json"])]
    unused: bool,
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
    if options.unused {
        println!("{}", nothing_unused_runs(workspace::Built::Released)?);
        return Ok(());
    }
    let tool = provide_valgrind()?;
    let program = workspace::example("instructions", workspace::Built::Released)?;
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
        let instructions = Counts::of_call(&program, name)?.total;
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

/// # Returns
/// The version of the valgrind that this machine has, or is given.
pub(crate) fn provide_valgrind() -> Result<String> {
    let version = Step::new("valgrind", ["--version"]);
    if !version.succeeds() {
        apt::install("valgrind").context(
            "callgrind, which counts the instructions, comes with valgrind, which is not installed \
             and cannot be",
        )?;
    }
    version.read()
}

fn print(report: &Report) {
    println!("instructions per call · {} · {} · {}", report.target, report.compiler, report.tool);
    println!("{:<24} {:<12} {:<6} {:>12}", "algorithm", "model", "scalar", "instructions");
    for Row { algorithm, model, scalar, instructions } in &report.rows {
        println!("{algorithm:<24} {model:<12} {scalar:<6} {instructions:>12}");
    }
}

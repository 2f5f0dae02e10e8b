//! `surefoot reproduce`

use super::report::percent;
use super::{RUN_FAILED, say};
use crate::experiments::{Comparison, table_2_1, table_2_2};
use clap::Parser;
use indicatif::ProgressBar;
use serde_json::json;
use std::fmt::Write;
use std::process::ExitCode;
use std::time::Duration;

/// Options of `reproduce`.
#[derive(Debug, Parser)]
pub struct Options {
    /// What to reproduce
    #[arg(value_enum, default_value = "all")]
    figure: Figure,
    /// One JSON document instead of tables
    #[arg(long)]
    json: bool,
}

/// What the text prints.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Figure {
    /// Free rigid body
    #[value(name = "table-2.1")]
    Table21,
    /// Double spherical pendulum
    #[value(name = "table-2.2")]
    Table22,
    /// Everything
    All,
}

/// Reproduces and compares.
pub fn reproduce(options: &Options) -> ExitCode {
    let tables = [
        (Figure::Table21, "table-2.1", table_2_1 as fn() -> Result<_, _>, READING_2_1),
        (Figure::Table22, "table-2.2", table_2_2, READING_2_2),
    ];
    let mut documents = Vec::new();
    for (figure, name, table, reading) in tables {
        if ![figure, Figure::All].contains(&options.figure) {
            continue;
        }
        let spinner = ProgressBar::new_spinner().with_message(name);
        spinner.enable_steady_tick(Duration::from_millis(100));
        let rows = table();
        spinner.finish_and_clear();
        match rows {
            Ok(rows) if options.json => {
                documents.push(json!({ "figure": name, "reading": reading, "rows": rows }));
            }
            Ok(rows) => say(&text(name, reading, &rows)),
            Err(error) => {
                eprintln!("error: {name}: {error}");
                return ExitCode::from(RUN_FAILED);
            }
        }
    }
    if options.json {
        let document = match documents.len() {
            1 => documents.remove(0),
            _ => json!(documents),
        };
        say(&format!("{document:#}\n"));
    }
    ExitCode::SUCCESS
}

const READING_2_1: &str = "301 samples, every 0.1 s from 0 to 30 s; energy and momentum against the \
    first pair of 1e-5 s, quaternions against the run of 1e-4 s";
const READING_2_2: &str = "301 samples, every 0.1 s from 0 to 30 s; against the energy-momentum run of \
    1e-4 s, and the start's energy and momentum; initial values as printed, rounded";

fn text(name: &str, reading: &str, rows: &[Comparison]) -> String {
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = writeln!(out, "{name}: {reading}");
    let _ = writeln!(out, "  {:<40}{:>12}{:>12}{:>9}", "", "ours", "printed", "diff");
    for row in rows {
        let _ = writeln!(
            out,
            "  {:<40}{:>12.3e}{:>12.3e}{:>9}",
            row.figure,
            row.ours,
            row.printed,
            percent(row.relative_difference),
        );
    }
    out
}

//! `surefoot chart stability`: the longest steps of methods on mechanisms.

use super::super::{bad_input, say};
use super::Options;
use crate::stability::{Limit, Scan, problems, scan};
use indicatif::ProgressBar;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Scans all methods on all problems.
pub(super) fn scan_steps(options: &Options) -> ExitCode {
    let bar = ProgressBar::new(0);
    let scan = scan(&|done, all| {
        bar.set_length(all as u64);
        bar.set_position(done as u64);
    });
    bar.finish_and_clear();
    let file = match write_csv(&options.out, &scan) {
        Ok(file) => file,
        Err(message) => return bad_input(&message, options.json),
    };
    if options.json {
        let document = serde_json::json!({ "chart": "stability", "scan": scan, "file": file });
        say(&format!("{document:#}\n"));
    } else {
        say(&text(&scan));
        say(&format!("written: {}\n", file.display()));
    }
    ExitCode::SUCCESS
}

fn text(scan: &Scan) -> String {
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = writeln!(
        out,
        "Longest steps of 30 s, in a geometric scan of {:.0} %: energy stays within a tenth of the \n\
         largest kinetic energy, constraints within a hundredth of their terms.",
        100.0 * (scan.ratio - 1.0),
    );
    for problem in problems() {
        let limits: Vec<&Limit> =
            scan.limits.iter().filter(|limit| limit.problem == problem.name).collect();
        let _ = writeln!(out, "\n{}: {}", problem.name, problem.description);
        let _ = writeln!(
            out,
            "  {:<24}{:>10}{:>12}  {:<14}{:>10}{:>9}",
            "method", "works to", "fails from", "by", "foretold", "ratio"
        );
        for limit in limits {
            let _ = writeln!(
                out,
                "  {:<24}{:>10}{:>12}  {:<14}{:>10}{:>9}",
                limit.method.name(),
                limit.works_to_s.map_or("none".into(), seconds),
                limit.fails_from_s.map_or("–".into(), seconds),
                limit.kind.map_or("", |kind| kind.words()),
                limit.forecast_s.map_or("–".into(), seconds),
                ratio(limit).map_or("–".into(), |ratio| format!("{ratio:.2}")),
            );
        }
    }
    let ratios: Vec<f64> = scan.limits.iter().filter_map(ratio).collect();
    let within = ratios.iter().filter(|ratio| (0.5..=2.0).contains(*ratio)).count();
    let unsafe_side = ratios.iter().filter(|ratio| **ratio < 0.9).count();
    let _ = writeln!(
        out,
        "\nForetold within a factor of two: {within} of {}; more than 10 % too long: {unsafe_side}.",
        ratios.len(),
    );
    out
}

fn seconds(time: f64) -> String {
    format!("{time:.4} s")
}

/// Observed over foretold: below 1 the forecast was too bold.
fn ratio(limit: &Limit) -> Option<f64> {
    Some(limit.works_to_s? / limit.forecast_s?)
}

fn write_csv(folder: &Path, scan: &Scan) -> Result<PathBuf, String> {
    let path = folder.join("stability.csv");
    let context = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    std::fs::create_dir_all(folder).map_err(|error| context(&error))?;
    let mut writer = csv::Writer::from_path(&path).map_err(|error| context(&error))?;
    for limit in &scan.limits {
        writer.serialize(limit).map_err(|error| context(&error))?;
    }
    writer.flush().map_err(|error| context(&error))?;
    Ok(path)
}

//! `surefoot chart stability`: the longest steps of methods on mechanisms.

use crate::report::{StepRow, StepTable};
use crate::stability::{Agreement, Limit, RATIO, Scan, ScanStore, all_problems, scan_problems};
use indicatif::ProgressBar;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use surefoot_mechanics::forecast::FailureKind;
use surefoot_sim::written::write_rows;

/// Takes up what an earlier call has left, and scans the other methods and problems, with a bar over them.
pub(super) fn scan_steps(folder: &Path, fresh: bool) -> Result<Scan, String> {
    let problems = all_problems().map_err(|error| error.to_string())?;
    let path = folder.join("stability.limits.json");
    let store = ScanStore::new(&path, &problems, RATIO, &super::this_program()?);
    if fresh {
        store.forget().map_err(|error| error.to_string())?;
    }
    let bar = ProgressBar::new(0);
    let scan = scan_problems(&problems, RATIO, &store, &|done, all| {
        bar.set_length(all as u64);
        bar.set_position(done as u64);
    });
    bar.finish_and_clear();
    scan.map_err(|error| error.to_string())
}

/// The tables for a page.
pub(super) fn tables(scan: &Scan) -> Vec<StepTable> {
    let row = |limit: &Limit| StepRow {
        method: limit.method.name(),
        works_to: limit.works_to_s.map_or("none".into(), seconds),
        fails_by: limit.kind.map_or("–", FailureKind::words).to_owned(),
        foretold: foretold(limit),
        foretold_by: limit.forecast_kind.map_or("–", FailureKind::words).to_owned(),
        ratio: agreement(limit),
    };
    let table = |(name, description): &(&'static str, &'static str)| StepTable {
        name: (*name).to_owned(),
        description: (*description).to_owned(),
        rows: scan.limits.iter().filter(|limit| limit.problem == *name).map(row).collect(),
    };
    scan.problems.iter().map(table).collect()
}

pub(super) fn text(scan: &Scan) -> String {
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = writeln!(
        out,
        "Longest steps of 30 s, in a geometric scan of {:.0} %: energy stays within a tenth of the \n\
         largest kinetic energy, constraints within a hundredth of their terms.",
        100.0 * (scan.ratio - 1.0),
    );
    for (name, description) in &scan.problems {
        let limits: Vec<&Limit> =
            scan.limits.iter().filter(|limit| limit.problem == *name).collect();
        let _ = writeln!(out, "\n{name}: {description}");
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
                foretold(limit),
                agreement(limit),
            );
        }
    }
    out.push('\n');
    let _ = writeln!(out, "Longest steps, {}.", scan.tally().words());
    out
}

/// The step foretold.
pub(super) fn foretold(limit: &Limit) -> String {
    match (limit.forecast_s, limit.forecast_kind) {
        (Some(step_s), _) => seconds(step_s),
        (None, Some(_)) => "none".to_owned(),
        (None, None) => "no limit".to_owned(),
    }
}

pub(super) fn seconds(time: f64) -> String {
    format!("{time:.4} s")
}

/// Found over foretold, in words.
pub(super) fn agreement(limit: &Limit) -> String {
    match limit.agreement() {
        Agreement::Ratio(ratio) => format!("{ratio:.2}"),
        Agreement::Unlimited | Agreement::NoneWorks => "as told".to_owned(),
        Agreement::TooCautious => "cautious".to_owned(),
        Agreement::TooBold => "bold".to_owned(),
    }
}

pub(super) fn write_csv(folder: &Path, scan: &Scan) -> Result<PathBuf, String> {
    let path = folder.join("stability.csv");
    write_rows(&path, |writer| scan.limits.iter().try_for_each(|limit| writer.serialize(limit)))?;
    Ok(path)
}

//! The files that a run leaves.

use std::fs::File;
use std::path::{Path, PathBuf};
use surefoot_sim::record::{Event, Record, SavedRun, write_csv, write_mcap};
use surefoot_sim::written::{write_text, write_whole};

/// A figure: the name of its file without the ending, and SVG.
pub(super) type Drawing = (&'static str, String);

/// Writes the report, the record in both forms, and the figures; says which files these are.
pub(super) fn write_run(
    folder: &Path,
    record: &dyn Record,
    events: &[Event],
    page: impl FnOnce() -> Result<String, String>,
    figures: impl FnOnce() -> Result<Vec<Drawing>, String>,
) -> Result<Vec<PathBuf>, String> {
    let _taken = taken(folder);
    let named = |name: &str| folder.join(name);
    let (csv, mcap, report) = (named("record.csv"), named("record.mcap"), named("report.html"));
    write_whole(&csv, |to| write_csv(record, to))?;
    write_whole(&mcap, |to| write_mcap(record, events, to))?;
    write_text(&report, &page()?)?;
    let mut files = vec![report, csv, mcap];
    for (name, svg) in figures()? {
        let file = named(&format!("{name}.svg"));
        write_text(&file, &svg)?;
        files.push(file);
    }
    Ok(files)
}

/// Makes the folder.
pub(super) fn made(folder: &Path) -> Result<(), String> {
    std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))
}

/// Takes the folder for oneself, as far as the system can, so that files of two runs at once do not mix. Systems that
/// cannot open or lock folders are left with whole files of either run.
fn taken(folder: &Path) -> Option<File> {
    File::open(folder).ok().filter(|folder| folder.lock().is_ok())
}

/// Refuses a folder with a record that begins before the one that a run would write there, as it does that goes on from
/// another one: what that one left would be lost.
pub(super) fn keeps_record(folder: &Path, from: Option<&SavedRun>) -> Result<(), String> {
    let Some(saved) = from else { return Ok(()) };
    let record = folder.join("record.csv");
    // A file that is no record loses nothing that a run has made.
    let Some(begins) = first_time(&record).filter(|begins| *begins < saved.time_s) else {
        return Ok(());
    };
    Err(format!(
        "{}: it holds a record from {begins} s on, and this run's begins at {} s: --out must name another folder",
        record.display(),
        saved.time_s
    ))
}

fn first_time(record: &Path) -> Option<f64> {
    let mut rows = csv::Reader::from_path(record).ok()?;
    let first = rows.records().next()?.ok()?;
    first.get(0)?.parse().ok()
}

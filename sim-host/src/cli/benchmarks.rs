//! `surefoot reproduce benchmarks`

use super::reproduce::Options;
use super::{RUN_FAILED, bad_input, complain, print};
use crate::benchmarks::{Benchmark, Effort, Row, all, iftomm_text, rows, table};
use crate::report::benchmarks_page;
use indicatif::ProgressBar;
use serde_json::json;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;
use surefoot_sim::written::write_text;

/// Plays the problems and compares.
pub(super) fn benchmarks(options: &Options) -> ExitCode {
    let chosen: Vec<&Benchmark> = match &options.rows[..] {
        [] => all().iter().collect(),
        names => {
            if let Some(unknown) = names.iter().find(|name| all().iter().all(|b| b.name != **name))
            {
                let known: Vec<&str> = all().iter().map(|b| b.name).collect();
                let message = format!("--row {unknown}: expected one of {}", known.join(", "));
                return bad_input(&message, options.json);
            }
            all().iter().filter(|b| names.iter().any(|name| name == b.name)).collect()
        }
    };
    let effort = Effort { advice: !options.quick, peers: !options.quick };
    let spinner = ProgressBar::new_spinner();
    spinner.enable_steady_tick(Duration::from_millis(100));
    let made = rows(&chosen, effort, &|name| spinner.set_message(name.to_owned()));
    spinner.finish_and_clear();
    let made = match made {
        Ok(made) => made,
        Err(error) => {
            complain(format_args!("error: benchmarks: {error}"));
            return ExitCode::from(RUN_FAILED);
        }
    };
    let files = match files(&made, &options.out.join("benchmarks")) {
        Ok(files) => files,
        Err(message) => return bad_input(&message, options.json),
    };
    let text = if options.json {
        format!("{:#}\n", json!({ "rows": made, "files": files }))
    } else {
        let page = files.first().map_or(String::new(), |page| page.display().to_string());
        format!("{}\n  {page}\n", table(&made))
    };
    match print(&text) {
        Ok(()) => ExitCode::SUCCESS,
        Err(status) => status,
    }
}

/// The page, and each run as it is submitted to IFToMM's library.
fn files(rows: &[Row], folder: &Path) -> Result<Vec<PathBuf>, String> {
    std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let page = benchmarks_page(rows).map_err(|error| error.to_string())?;
    let mut all = vec![folder.join("benchmarks.html")];
    write_text(&folder.join("benchmarks.html"), &page)?;
    for row in rows {
        let Some(played) = &row.played else { continue };
        let path = folder.join(format!("{}.txt", row.name));
        write_text(&path, &iftomm_text(played))?;
        all.push(path);
    }
    Ok(all)
}

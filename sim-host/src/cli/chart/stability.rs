//! `surefoot chart stability`: the longest steps of all methods, and the maps.

use super::super::{bad_input, say};
use super::maps::{self, Mapped};
use super::{Options, Part, map_picture, steps};
use crate::report::{ForecastCounts, MapFigure, stability_page};
use crate::stability::maps::tell;
use crate::stability::{Scan, Tally};
use serde_json::json;
use std::path::PathBuf;
use std::process::ExitCode;

/// Scans, maps, and writes both.
pub(super) fn chart_stability(options: &Options) -> ExitCode {
    match make(options) {
        Ok((scan, mapped, files)) => {
            if options.json {
                let document = json!({
                    "chart": "stability",
                    "scan": scan,
                    "maps": mapped.as_ref().map(Mapped::json),
                    "forecasts": {
                        "steps": scan.as_ref().map(Scan::tally),
                        "maps": mapped.as_ref().map(Mapped::tally),
                        "all": in_all(scan.as_ref(), mapped.as_ref()),
                    },
                    "files": files,
                });
                say(&format!("{document:#}\n"));
                return ExitCode::SUCCESS;
            }
            let scanned = scan.as_ref().map(steps::text);
            let maps = mapped.as_ref().map(Mapped::text);
            say(&(scanned.unwrap_or_default() + &maps.unwrap_or_default()));
            say(&format!("\nIn all, {}.\n", in_all(scan.as_ref(), mapped.as_ref()).words()));
            for file in files {
                say(&format!("written: {}\n", file.display()));
            }
            ExitCode::SUCCESS
        }
        Err(message) => bad_input(&message, options.json),
    }
}

/// How many forecasts hold, of the scan and all maps.
fn in_all(scan: Option<&Scan>, mapped: Option<&Mapped>) -> Tally {
    scan.map(Scan::tally).into_iter().chain(mapped.map(Mapped::tally)).sum()
}

type Made = (Option<Scan>, Option<Mapped>, Vec<PathBuf>);

fn make(options: &Options) -> Result<Made, String> {
    let folder = &options.out;
    std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let wants = |part| options.part.is_none_or(|only| only == part);
    let scan = wants(Part::Steps).then(|| steps::scan_steps(folder, options.fresh)).transpose()?;
    let mapped = wants(Part::Maps)
        .then(|| maps::make(folder, options.cells.into(), options.fresh))
        .transpose()?;
    let mut files = Vec::new();
    if let Some(scan) = &scan {
        files.push(steps::write_csv(folder, scan)?);
    }
    if let Some(mapped) = &mapped {
        files.extend(mapped.write(folder)?);
    }
    files.push(write_page(options, scan.as_ref(), mapped.as_ref())?);
    Ok((scan, mapped, files))
}

fn write_page(
    options: &Options,
    scan: Option<&Scan>,
    mapped: Option<&Mapped>,
) -> Result<PathBuf, String> {
    let figures = mapped.into_iter().flat_map(Mapped::iter).map(|(map, columns)| {
        let drawing = map_picture::picture(map, columns).svg();
        Ok(MapFigure {
            // In a page it needs no namespace.
            drawing: drawing.map_err(|error| error.to_string())?.replacen(
                " xmlns=\"http://www.w3.org/2000/svg\"",
                "",
                1,
            ),
            says: tell(map, columns),
            note: map.note.to_owned(),
        })
    });
    let figures = figures.collect::<Result<Vec<MapFigure>, String>>()?;
    let tables = scan.map(steps::tables).unwrap_or_default();
    let sentence = |what: &str, tally: Tally| format!("{what}, {}.", tally.words());
    let counts = ForecastCounts {
        all: sentence("Of everything on this page", in_all(scan, mapped)),
        maps: mapped
            .map_or(String::new(), |mapped| sentence("Columns of all maps", mapped.tally())),
        steps: scan.map_or(String::new(), |scan| sentence("Longest steps", scan.tally())),
    };
    let page = stability_page(&figures, &tables, &counts).map_err(|error| error.to_string())?;
    let path = options.out.join("stability.html");
    std::fs::write(&path, page).map_err(|error| format!("{}: {error}", path.display()))?;
    Ok(path)
}

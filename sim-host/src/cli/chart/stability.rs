//! `surefoot chart stability`: the longest steps of all methods, and the maps.

use super::super::{bad_input, say};
use super::maps::{self, Mapped};
use super::{Options, Part, map_picture, steps};
use crate::report::{MapFigure, stability_page};
use crate::stability::Scan;
use crate::stability::maps::tell;
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
                    "files": files,
                });
                say(&format!("{document:#}\n"));
                return ExitCode::SUCCESS;
            }
            let scanned = scan.as_ref().map(steps::text);
            say(&(scanned.unwrap_or_default() + &mapped.map_or(String::new(), |m| m.text())));
            for file in files {
                say(&format!("written: {}\n", file.display()));
            }
            ExitCode::SUCCESS
        }
        Err(message) => bad_input(&message, options.json),
    }
}

type Made = (Option<Scan>, Option<Mapped>, Vec<PathBuf>);

fn make(options: &Options) -> Result<Made, String> {
    let folder = &options.out;
    std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let wants = |part| options.part.is_none_or(|only| only == part);
    let scan = wants(Part::Steps).then(steps::scan_steps).transpose()?;
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
    let counts = scan.map_or(String::new(), |scan| steps::counts(&scan.limits));
    let page = stability_page(&figures, &tables, &counts).map_err(|error| error.to_string())?;
    let path = options.out.join("stability.html");
    std::fs::write(&path, page).map_err(|error| format!("{}: {error}", path.display()))?;
    Ok(path)
}

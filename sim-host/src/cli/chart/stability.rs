//! `surefoot chart stability`: the longest steps of all methods, and the maps.

use super::maps::{self, Mapped};
use super::{Made, Options, Part, map_picture, steps};
use crate::report::{Figure, stability_chapter};
use crate::stability::Scan;
use crate::stability::maps::tell;
use serde_json::json;

/// Scans, maps, and writes both.
pub(super) fn chart(options: &Options) -> Result<Made, String> {
    let folder = &options.out;
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
    let scanned = scan.as_ref().map(steps::text);
    Ok(Made {
        text: scanned.unwrap_or_default() + &mapped.as_ref().map_or(String::new(), Mapped::text),
        json: json!({
            "chart": "stability",
            "scan": scan,
            "maps": mapped.as_ref().map(Mapped::json),
        }),
        files,
        chapter: chapter(scan.as_ref(), mapped.as_ref())?,
    })
}

fn chapter(scan: Option<&Scan>, mapped: Option<&Mapped>) -> Result<crate::report::Chapter, String> {
    let figure = |(map, columns): (&_, &[_])| {
        let drawing =
            map_picture::picture(map, columns).svg().map_err(|error| error.to_string())?;
        let files = ["svg", "csv"].map(|ending| format!("map-{}.{ending}", map.name));
        Ok(Figure::new(&drawing, tell(map, columns), map.note).with_files(files))
    };
    let figures: Result<Vec<Figure>, String> =
        mapped.into_iter().flat_map(Mapped::iter).map(figure).collect();
    let tables = scan.map(steps::tables).unwrap_or_default();
    let counts = scan.map_or(String::new(), |scan| steps::counts(&scan.limits));
    stability_chapter(&figures?, &tables, &counts, counts.clone())
        .map_err(|error| error.to_string())
}

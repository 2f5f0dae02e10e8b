//! `surefoot chart stability`: the longest steps of all methods, and the maps.

use super::maps::{self, Mapped};
use super::{Made, Options, Part, map_picture, steps};
use crate::report::{Chapter, Figure, ForecastCounts, stability_chapter};
use crate::stability::maps::{glance, tell};
use crate::stability::{Scan, Tally};
use serde_json::json;

/// Scans, maps, and writes both.
pub(super) fn chart(options: &Options) -> Result<Made, String> {
    let folder = &options.out;
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
    let scanned = scan.as_ref().map(steps::text);
    let maps = mapped.as_ref().map(Mapped::text);
    let all = in_all(scan.as_ref(), mapped.as_ref());
    Ok(Made {
        text: format!(
            "{}{}\nIn all, {}.\n",
            scanned.unwrap_or_default(),
            maps.unwrap_or_default(),
            all.words()
        ),
        json: json!({
            "chart": "stability",
            "scan": scan,
            "maps": mapped.as_ref().map(Mapped::json),
            "forecasts": {
                "steps": scan.as_ref().map(Scan::tally),
                "maps": mapped.as_ref().map(Mapped::tally),
                "all": all,
            },
        }),
        files,
        chapter: chapter(scan.as_ref(), mapped.as_ref())?,
    })
}

/// How many forecasts hold, of the scan and all maps.
fn in_all(scan: Option<&Scan>, mapped: Option<&Mapped>) -> Tally {
    scan.map(Scan::tally).into_iter().chain(mapped.map(Mapped::tally)).sum()
}

fn chapter(scan: Option<&Scan>, mapped: Option<&Mapped>) -> Result<Chapter, String> {
    let figure = |(map, columns): (&_, &[_])| {
        let drawing =
            map_picture::picture(map, columns).svg().map_err(|error| error.to_string())?;
        let files = ["svg", "csv"].map(|ending| format!("map-{}.{ending}", map.name));
        let note = format!("{} {}", tell(map, columns), map.note);
        Ok(Figure::new(&drawing, glance(map, columns), note).with_files(files))
    };
    let figures: Result<Vec<Figure>, String> =
        mapped.into_iter().flat_map(Mapped::iter).map(figure).collect();
    let tables = scan.map(steps::tables).unwrap_or_default();
    let sentence = |what: &str, tally: Tally| format!("{what}, {}.", tally.words());
    let counts = ForecastCounts {
        maps: mapped
            .map_or(String::new(), |mapped| sentence("Columns of all maps", mapped.tally())),
        steps: scan.map_or(String::new(), |scan| sentence("Longest steps", scan.tally())),
    };
    let all = sentence("of all limits", in_all(scan, mapped));
    stability_chapter(&figures?, &tables, &counts, all).map_err(|error| error.to_string())
}

//! `surefoot chart stability`: the maps in two parameters.

use super::map_picture::picture;
use crate::stability::maps::{Column, Failure, Foretold, Map, Outcome, maps, survey, tally, tell};
use crate::stability::{MapStore, Tally};
use indicatif::{ProgressBar, ProgressStyle};
use serde::Serialize;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::time::Duration;
use surefoot_sim::written::write_rows;

/// Maps, and the columns of each.
pub(super) struct Mapped {
    /// Maps.
    pub maps: Vec<Map>,
    /// Their columns.
    pub columns: Vec<Vec<Column>>,
}

/// A cell of the CSV.
#[derive(Serialize)]
struct Row {
    x: f64,
    y: f64,
    outcome: &'static str,
    failure: Option<&'static str>,
    works_to: Option<f64>,
    fails_from: Option<f64>,
    foretold: Option<f64>,
}

/// Takes up what an earlier call has left, and makes the rest, with a bar over the columns.
pub(super) fn make(folder: &Path, cells: usize, fresh: bool) -> Result<Mapped, String> {
    let maps = maps(cells).map_err(|error| error.to_string())?;
    let path = folder.join("maps.columns.json");
    let store = MapStore::new(&path, &maps, &super::this_program()?);
    if fresh {
        store.forget().map_err(|error| error.to_string())?;
    }
    let bar = bar();
    let columns = survey(&maps, &store, &|done, all| {
        bar.set_length(all as u64);
        bar.set_position(done as u64);
    });
    bar.finish_and_clear();
    Ok(Mapped { maps, columns: columns.map_err(|error| error.to_string())? })
}

fn bar() -> ProgressBar {
    let bar = ProgressBar::new(0);
    // The template is constant and valid; were it not, the default style would do.
    if let Ok(style) = ProgressStyle::with_template("maps {wide_bar} {pos}/{len} columns {elapsed}")
    {
        bar.set_style(style);
    }
    bar.enable_steady_tick(Duration::from_millis(500));
    bar
}

impl Mapped {
    /// Maps with their columns.
    pub fn iter(&self) -> impl Iterator<Item = (&Map, &[Column])> {
        self.maps.iter().zip(self.columns.iter().map(Vec::as_slice))
    }

    /// How many forecasts hold, of all maps.
    pub fn tally(&self) -> Tally {
        self.iter().map(|(map, columns)| tally(map, columns)).sum()
    }

    /// What each map says, and how many forecasts hold.
    pub fn text(&self) -> String {
        let mut text: String = self
            .iter()
            .map(|(map, columns)| format!("\n{}\n  {}\n", map.title, tell(map, columns)))
            .collect();
        text += &format!("\nColumns of all maps, {}.\n", self.tally().words());
        text
    }

    /// A drawing and a table of each map.
    pub fn write(&self, folder: &Path) -> Result<Vec<PathBuf>, String> {
        let mut files = Vec::new();
        for (map, columns) in self.iter() {
            let drawing = folder.join(format!("map-{}.svg", map.name));
            picture(map, columns).draw(&drawing).map_err(|error| error.to_string())?;
            let table = folder.join(format!("map-{}.csv", map.name));
            write_rows(&table, |writer| rows(writer, map, columns))?;
            files.extend([drawing, table]);
        }
        Ok(files)
    }

    /// Everything.
    pub fn json(&self) -> Vec<Value> {
        self.iter()
            .map(|(map, columns)| {
                json!({
                    "name": map.name,
                    "title": map.title,
                    "works_if": map.note,
                    "x": map.x,
                    "y": map.y,
                    "says": tell(map, columns),
                    "forecasts": tally(map, columns),
                    "columns": columns,
                })
            })
            .collect()
    }
}

fn rows<W: std::io::Write>(
    writer: &mut csv::Writer<W>,
    map: &Map,
    columns: &[Column],
) -> Result<(), csv::Error> {
    for column in columns {
        for (y, cell) in map.y.values().zip(&column.cells) {
            let failure = match cell {
                Outcome::Works => None,
                Outcome::Fails(failure) => Some(Failure::words(*failure)),
            };
            writer.serialize(Row {
                x: column.x,
                y,
                outcome: if failure.is_none() { "works" } else { "fails" },
                failure,
                works_to: column.works_to,
                fails_from: column.fails_from,
                foretold: match column.foretold {
                    Foretold::At(at) => Some(at),
                    _ => None,
                },
            })?;
        }
    }
    Ok(())
}

//! Runs in a folder: one line each, kept as soon as it is there, so that a study can be broken off, taken up again, cut
//! into shards, and put together.

use super::row::Row;
use super::study::{Definition, Study};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fs::{File, OpenOptions};
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use surefoot_sim::closed_loop::Scalar;
use surefoot_sim::written::{write_rows, write_text};

/// What a folder holds runs of.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Contents {
    /// What decides the samples.
    pub definition: Definition,
    /// Precision of the controller.
    pub scalar: Scalar,
    /// Samples of the whole study.
    pub samples: u64,
    /// Which part of it is here.
    pub shard: Shard,
}

/// A part of a study: each n-th sample, from the k-th on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Shard {
    /// `k`, from 1.
    pub number: u64,
    /// `n`
    pub of: u64,
}

/// Runs by the numbers of their samples.
pub type Rows = BTreeMap<u64, Row>;

impl Shard {
    /// All of a study.
    pub const WHOLE: Self = Self { number: 1, of: 1 };

    /// Numbers of its samples.
    pub fn samples(self, samples: u64) -> impl Iterator<Item = u64> {
        (self.number - 1..samples).step_by(self.of.max(1) as usize)
    }
}

impl std::str::FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let expected = || format!("{text}: expected k/n with k from 1 to n, as in 2/8");
        let (number, of) = text.split_once('/').ok_or_else(expected)?;
        let [number, of] = [number, of].map(|x| x.trim().parse::<u64>().ok());
        match (number, of) {
            (Some(number), Some(of)) if (1..=of).contains(&number) => Ok(Self { number, of }),
            _ => Err(expected()),
        }
    }
}

/// A folder of runs.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    lines: File,
}

/// Names of its files.
pub const CONTENTS: &str = "study.json";
/// One line a run.
pub const RUNS: &str = "runs.csv";

impl Folder {
    /// Begins anew, or goes on where one of the same samples was broken off; tells which runs are there.
    ///
    /// # Errors
    /// For a folder that cannot be written, for unfinished runs that `resume` does not go on with, and for runs of
    /// another study that it would go on with.
    pub fn open(
        path: &Path,
        study: &Study,
        contents: &Contents,
        resume: bool,
    ) -> Result<(Self, Rows), String> {
        std::fs::create_dir_all(path).map_err(|error| format!("{}: {error}", path.display()))?;
        let before = read_contents(path)?;
        let mut rows = Rows::new();
        if let Some(before) = before {
            let there = read_rows(path)?;
            let is_same = before.is_of(contents);
            if resume && !is_same {
                let differs = before.difference(contents);
                return Err(format!(
                    "{}: it holds runs of another study: {differs}",
                    path.display()
                ));
            }
            let is_unfinished =
                before.shard.samples(before.samples).any(|k| !there.contains_key(&k));
            if !resume && is_unfinished && !there.is_empty() {
                return Err(format!(
                    "{}: it holds {} runs of an unfinished study: --resume goes on with it, --out names another folder",
                    path.display(),
                    there.len()
                ));
            }
            if resume {
                rows = there;
            }
        }
        let text = serde_json::to_string_pretty(contents).map_err(|error| error.to_string())?;
        write_text(&path.join(CONTENTS), &format!("{text}\n"))?;
        // A last line that was not finished is gone.
        write_table(path, study, rows.values())?;
        let file = path.join(RUNS);
        let lines = OpenOptions::new().append(true).open(&file);
        let lines = lines.map_err(|error| format!("{}: {error}", file.display()))?;
        Ok((Self { path: path.to_owned(), lines }, rows))
    }

    /// Keeps a run.
    ///
    /// # Errors
    /// With the file's name.
    pub fn keep(&mut self, study: &Study, row: &Row) -> Result<(), String> {
        let mut line = csv::Writer::from_writer(Vec::new());
        let cells = cells(study, row);
        let line = line
            .write_record(&cells)
            .map_err(|error| error.to_string())
            .and_then(|()| line.into_inner().map_err(|error| error.to_string()))?;
        // In one piece, so that processes that die leave whole lines but for the last.
        let name = || self.path.join(RUNS).display().to_string();
        self.lines.write_all(&line).map_err(|error| format!("{}: {error}", name()))
    }

    /// Puts the lines in the order of the samples.
    ///
    /// # Errors
    /// With the file's name.
    pub fn finish(self, study: &Study, rows: &Rows) -> Result<(), String> {
        write_table(&self.path, study, rows.values())
    }
}

impl Contents {
    /// Whether samples of both are the same, however many.
    fn is_of(&self, other: &Self) -> bool {
        self.definition == other.definition && self.scalar == other.scalar
    }

    fn difference(&self, other: &Self) -> String {
        let (a, b) = (&self.definition, &other.definition);
        if a.scene_text != b.scene_text {
            return format!(
                "of the scene {}, not {}, or of another version of it",
                a.scene, b.scene
            );
        }
        if a.vary_text != b.vary_text {
            return format!("{} is not what it was", b.vary);
        }
        if a.seed != b.seed {
            return format!("--seed {}, not {}", a.seed, b.seed);
        }
        if a.sampling != b.sampling {
            return "another --sampling".to_owned();
        }
        match self.scalar == other.scalar {
            true => format!("{}, not {}", a.vary, b.vary),
            false => "another precision of the controller".to_owned(),
        }
    }
}

/// All values of a row: what is kept of the run, and the numbers of its coordinates.
fn cells(study: &Study, row: &Row) -> Vec<String> {
    let mut cells = row.cells();
    let numbers = study.numbers(&study.point(row.sample));
    cells.extend(numbers.iter().map(ToString::to_string));
    cells
}

fn write_table<'a>(
    folder: &Path,
    study: &Study,
    rows: impl Iterator<Item = &'a Row>,
) -> Result<(), String> {
    write_rows(&folder.join(RUNS), |writer| {
        let mut head = Row::columns();
        head.extend(study.coordinates().iter().map(|coordinate| coordinate.name.clone()));
        writer.write_record(&head)?;
        rows.into_iter().try_for_each(|row| writer.write_record(cells(study, row)))
    })
}

/// What a folder holds runs of; `None` where it holds none.
fn read_contents(folder: &Path) -> Result<Option<Contents>, String> {
    let path = folder.join(CONTENTS);
    match std::fs::read_to_string(&path) {
        Ok(text) => {
            let contents = serde_json::from_str(&text);
            contents.map(Some).map_err(|error| format!("{}: {error}", path.display()))
        }
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(format!("{}: {error}", path.display())),
    }
}

/// Its finished runs.
fn read_rows(folder: &Path) -> Result<Rows, String> {
    let path = folder.join(RUNS);
    let text = match std::fs::read_to_string(&path) {
        Ok(text) => text,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Rows::new()),
        Err(error) => return Err(format!("{}: {error}", path.display())),
    };
    // What has no end of line was being written when the program was ended.
    let whole = text.rfind('\n').map_or("", |end| &text[..=end]);
    let mut reader = csv::ReaderBuilder::new().flexible(true).from_reader(whole.as_bytes());
    let columns = Row::columns().len();
    let mut rows = Rows::new();
    for (line, record) in reader.records().enumerate() {
        let cells: Vec<String> = record
            .map(|record| record.iter().take(columns).map(str::to_owned).collect())
            .map_err(|error| format!("{}: {error}", path.display()))?;
        let row = Row::from_cells(&cells).ok_or_else(|| {
            format!(
                "{}:{}: no run; expected {columns} columns as in the head",
                path.display(),
                line + 2
            )
        })?;
        rows.insert(row.sample, row);
    }
    Ok(rows)
}

/// Puts runs of several folders together: shards of one study.
///
/// # Errors
/// For folders of different studies, for samples that are nowhere, and for samples of which two folders tell
/// different runs.
pub fn merge(folders: &[PathBuf]) -> Result<(Study, Contents, Rows), String> {
    let mut merged: Option<(&Path, Contents)> = None;
    let mut rows: BTreeMap<u64, (&Path, Row)> = BTreeMap::new();
    for folder in folders {
        let folder = folder.as_path();
        let contents = read_contents(folder)?.ok_or_else(|| {
            format!(
                "{}: no {CONTENTS}; expected a folder that `certify` has written",
                folder.display()
            )
        })?;
        if let Some((first, of_first)) = &merged {
            let wrong =
                |what: String| Err(format!("{} and {}: {what}", first.display(), folder.display()));
            if !of_first.is_of(&contents) {
                return wrong(format!("different studies: {}", of_first.difference(&contents)));
            }
            if of_first.samples != contents.samples {
                return wrong(format!("--samples {} and {}", of_first.samples, contents.samples));
            }
        }
        for (sample, row) in read_rows(folder)? {
            match rows.get(&sample) {
                Some((other, known)) if *known != row => {
                    return Err(format!(
                        "sample {sample}: {} and {} have different runs of it (bits {} and {})",
                        other.display(),
                        folder.display(),
                        known.bits,
                        row.bits
                    ));
                }
                _ => {
                    rows.insert(sample, (folder, row));
                }
            }
        }
        merged.get_or_insert((folder, contents));
    }
    let Some((_, contents)) = merged else {
        return Err("no folders: expected those of all shards".to_owned());
    };
    let contents = Contents { shard: Shard::WHOLE, ..contents };
    let missing: Vec<u64> = (0..contents.samples).filter(|k| !rows.contains_key(k)).collect();
    if let [first, ..] = &missing[..] {
        return Err(format!(
            "{} of {} samples are in none of the folders, the first is {first}: expected all shards, finished",
            missing.len(),
            contents.samples
        ));
    }
    let rows = rows.into_iter().filter(|(k, _)| *k < contents.samples);
    let rows = rows.map(|(k, (_, row))| (k, row)).collect();
    let study = Study::new(contents.definition.clone()).map_err(|error| error.to_string())?;
    Ok((study, contents, rows))
}

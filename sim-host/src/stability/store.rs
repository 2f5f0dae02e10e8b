//! Finished parts of a chart in a file, so that it can be broken off and taken up again.

use super::loop_limits::fingerprint;
use super::maps::{Column, Map};
use super::problem::Problem;
use super::scan::Limit;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::marker::PhantomData;
use std::path::{Path, PathBuf};
use surefoot_sim::written::write_text;

/// Finished parts cannot be read or kept.
#[derive(Debug, thiserror::Error)]
#[error("{}: {reason}", path.display())]
pub struct PartStoreError {
    path: PathBuf,
    reason: String,
}

/// A file of finished parts, of one chart by one program.
#[derive(Clone, Debug)]
pub struct PartStore<Part> {
    path: PathBuf,
    fingerprint: String,
    part: PhantomData<Part>,
}

/// Of maps: their columns.
pub type MapStore = PartStore<Column>;
/// Of a scan of steps: its limits.
pub type ScanStore = PartStore<Limit>;

/// Parts by what they are of, and number: a map's columns, a problem's methods.
pub type Parts<Part> = BTreeMap<String, BTreeMap<usize, Part>>;

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Finished<Part> {
    fingerprint: String,
    parts: Parts<Part>,
}

impl PartStore<Column> {
    /// At a path, for maps, and a program whose bytes these are: another program's columns may have come
    /// about otherwise.
    pub fn new(path: &Path, maps: &[Map], program: &[u8]) -> Self {
        let axes: Vec<_> = maps.iter().map(|map| (map.name, map.x, map.y)).collect();
        Self::of(path, &format!("{axes:?}"), program)
    }
}

impl PartStore<Limit> {
    /// At a path, for problems scanned with steps in a ratio, and a program whose bytes these are.
    pub fn new(path: &Path, problems: &[Problem], ratio: f64, program: &[u8]) -> Self {
        let what: Vec<_> =
            problems.iter().map(|each| (each.name, each.description, each.range_s)).collect();
        Self::of(path, &format!("{ratio} {what:?}"), program)
    }
}

impl<Part: Clone + Serialize + DeserializeOwned> PartStore<Part> {
    fn of(path: &Path, what: &str, program: &[u8]) -> Self {
        let fingerprint = fingerprint(&[what.as_bytes(), program]);
        Self { path: path.to_owned(), fingerprint, part: PhantomData }
    }

    /// What is finished: nothing where there is no file, or one of another chart or program.
    ///
    /// # Errors
    /// [`PartStoreError`] for a file that cannot be read, or is no file of parts.
    pub fn finished(&self) -> Result<Parts<Part>, PartStoreError> {
        let text = match std::fs::read_to_string(&self.path) {
            Ok(text) => text,
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Parts::new()),
            Err(error) => return Err(self.error(&error)),
        };
        let finished: Finished<Part> = serde_json::from_str(&text)
            .map_err(|error| self.error(&format!("{error} (start anew with --fresh)")))?;
        let ours = finished.fingerprint == self.fingerprint;
        Ok(if ours { finished.parts } else { Parts::new() })
    }

    /// Replaces what is there, at once or not at all.
    ///
    /// # Errors
    /// [`PartStoreError`].
    pub fn keep(&self, parts: &Parts<Part>) -> Result<(), PartStoreError> {
        let finished = Finished { fingerprint: self.fingerprint.clone(), parts: parts.clone() };
        let text = serde_json::to_string(&finished).map_err(|error| self.error(&error))?;
        write_text(&self.path, &text).map_err(|error| self.error(&error))
    }

    /// Takes the file away.
    ///
    /// # Errors
    /// [`PartStoreError`].
    pub fn forget(&self) -> Result<(), PartStoreError> {
        match std::fs::remove_file(&self.path) {
            Err(error) if error.kind() != ErrorKind::NotFound => Err(self.error(&error)),
            _ => Ok(()),
        }
    }

    fn error(&self, reason: &dyn std::fmt::Display) -> PartStoreError {
        PartStoreError { path: self.path.clone(), reason: reason.to_string() }
    }
}

//! Finished columns in a file, so that maps can be broken off and taken up again.

use super::column::{Column, Map};
use crate::stability::loop_limits::fingerprint;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// Finished columns cannot be read or kept.
#[derive(Debug, thiserror::Error)]
#[error("{}: {reason}", path.display())]
pub struct MapStoreError {
    path: PathBuf,
    reason: String,
}

/// A file of finished columns, of one set of maps by one program.
#[derive(Clone, Debug)]
pub struct MapStore {
    path: PathBuf,
    fingerprint: String,
}

/// Columns by the map's name and the column's number.
pub type Columns = BTreeMap<String, BTreeMap<usize, Column>>;

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Finished {
    fingerprint: String,
    columns: Columns,
}

impl MapStore {
    /// At a path, for maps, and a program whose bytes these are: another program's columns may have come
    /// about otherwise.
    pub fn new(path: &Path, maps: &[Map], program: &[u8]) -> Self {
        let axes: Vec<_> = maps.iter().map(|map| (map.name, map.x, map.y)).collect();
        let fingerprint = fingerprint(&[format!("{axes:?}").as_bytes(), program]);
        Self { path: path.to_owned(), fingerprint }
    }

    /// What is finished: nothing where there is no file, or one of other maps.
    ///
    /// # Errors
    /// [`MapStoreError`] for a file that cannot be read, or is no file of columns.
    pub fn finished(&self) -> Result<Columns, MapStoreError> {
        let text = match std::fs::read_to_string(&self.path) {
            Ok(text) => text,
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Columns::new()),
            Err(error) => return Err(self.error(&error)),
        };
        let finished: Finished = serde_json::from_str(&text)
            .map_err(|error| self.error(&format!("{error} (start anew with --fresh)")))?;
        let ours = finished.fingerprint == self.fingerprint;
        Ok(if ours { finished.columns } else { Columns::new() })
    }

    /// Replaces what is there, at once or not at all.
    ///
    /// # Errors
    /// [`MapStoreError`].
    pub fn keep(&self, columns: &Columns) -> Result<(), MapStoreError> {
        let finished = Finished { fingerprint: self.fingerprint.clone(), columns: columns.clone() };
        let text = serde_json::to_string(&finished).map_err(|error| self.error(&error))?;
        let draft = self.path.with_extension("draft");
        std::fs::write(&draft, text)
            .and_then(|()| std::fs::rename(&draft, &self.path))
            .map_err(|error| self.error(&error))
    }

    /// Takes the file away.
    ///
    /// # Errors
    /// [`MapStoreError`].
    pub fn forget(&self) -> Result<(), MapStoreError> {
        match std::fs::remove_file(&self.path) {
            Err(error) if error.kind() != ErrorKind::NotFound => Err(self.error(&error)),
            _ => Ok(()),
        }
    }

    fn error(&self, reason: &dyn std::fmt::Display) -> MapStoreError {
        MapStoreError { path: self.path.clone(), reason: reason.to_string() }
    }
}

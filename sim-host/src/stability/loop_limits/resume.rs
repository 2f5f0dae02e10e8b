//! Finished cells in a file, so that a survey can be broken off and taken up again.

use super::cell::{Cell, HALVINGS};
use super::criterion::Criterion;
use super::manner::{BEFORE_S, LEANING_DEG, RUNAWAY, RUNAWAY_TICKS, SLIP_M};
use super::quantity::{ACCELEROMETER_NOISE, GYROSCOPE_NOISE, Quantity};
use serde::{Deserialize, Serialize};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use surefoot_sim::scene::Scene;
use surefoot_sim::written::write_text;

/// To be raised when a rule changes that is not in a number of its own.
const RULES: u32 = 1;

/// Finished cells cannot be read or kept.
#[derive(Debug, thiserror::Error)]
#[error("{}: {reason}", path.display())]
pub struct StoreError {
    path: PathBuf,
    reason: String,
}

/// A file of finished cells, of one scene under one set of rules.
#[derive(Clone, Debug)]
pub struct Store {
    path: PathBuf,
    fingerprint: String,
}

/// What is in the file.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Finished {
    fingerprint: String,
    cells: Vec<Cell>,
}

impl Store {
    /// At a path, for a scene, a criterion, and a program whose bytes these are: another program's cells
    /// may have come about otherwise.
    pub fn new(path: &Path, scene: &Scene, criterion: &Criterion, program: &[u8]) -> Self {
        let searches: Vec<_> = Quantity::ALL
            .iter()
            .map(|quantity| (quantity, quantity.ladder(scene), quantity.tolerance()))
            .collect();
        let numbers = [
            BEFORE_S,
            LEANING_DEG,
            RUNAWAY,
            RUNAWAY_TICKS as f64,
            SLIP_M,
            GYROSCOPE_NOISE,
            ACCELEROMETER_NOISE,
            HALVINGS as f64,
        ];
        let rules = format!("{scene:?} {criterion:?} {searches:?} {numbers:?} {RULES}");
        let fingerprint = fingerprint(&[rules.as_bytes(), program]);
        Self { path: path.to_owned(), fingerprint }
    }

    /// The cells that are finished: none where there is no file, or one of other rules.
    ///
    /// # Errors
    /// [`StoreError`] for a file that cannot be read, or is no file of cells.
    pub fn finished(&self) -> Result<Vec<Cell>, StoreError> {
        let text = match std::fs::read_to_string(&self.path) {
            Ok(text) => text,
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Vec::new()),
            Err(error) => return Err(self.error(&error)),
        };
        let finished: Finished = serde_json::from_str(&text)
            .map_err(|error| self.error(&format!("{error} (start anew with --fresh)")))?;
        let ours = finished.fingerprint == self.fingerprint;
        Ok(if ours { finished.cells } else { Vec::new() })
    }

    /// Replaces the file's cells by these, at once or not at all.
    ///
    /// # Errors
    /// [`StoreError`].
    pub fn keep(&self, cells: &[Cell]) -> Result<(), StoreError> {
        let finished = Finished { fingerprint: self.fingerprint.clone(), cells: cells.to_vec() };
        let text = serde_json::to_string_pretty(&finished).map_err(|error| self.error(&error))?;
        write_text(&self.path, &text).map_err(|error| self.error(&error))
    }

    /// Takes the file away.
    ///
    /// # Errors
    /// [`StoreError`].
    pub fn forget(&self) -> Result<(), StoreError> {
        match std::fs::remove_file(&self.path) {
            Err(error) if error.kind() != ErrorKind::NotFound => Err(self.error(&error)),
            _ => Ok(()),
        }
    }

    fn error(&self, reason: &dyn std::fmt::Display) -> StoreError {
        StoreError { path: self.path.clone(), reason: reason.to_string() }
    }
}

/// A number in hexadecimal digits that tells these bytes from others.
pub(in crate::stability) fn fingerprint(parts: &[&[u8]]) -> String {
    format!("{:016x}", parts.iter().fold(SEED, |so_far, part| hash(so_far, part)))
}

const SEED: u64 = 0xcbf2_9ce4_8422_2325;

/// FNV-1a, which is the same for every compiler and machine.
fn hash(from: u64, bytes: &[u8]) -> u64 {
    bytes
        .iter()
        .fold(from, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3))
}

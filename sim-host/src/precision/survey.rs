//! All methods on a problem, kept as they are finished.

use super::catalogue::{CatalogueError, problem};
use super::contender::Contender;
use super::peers::{Mujoco, NoMujoco, peer_contenders};
use super::problem::Omission;
use super::reference::{NoReference, Reference, reference};
use super::sweep::{Curve, Effort, sweep};
use serde::{Deserialize, Serialize, de::DeserializeOwned};
use std::collections::hash_map::DefaultHasher;
use std::hash::{Hash, Hasher};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use surefoot_sim::written::write_text;

/// What was found on a problem.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Survey {
    /// Its name.
    pub problem: String,
    /// What it is.
    pub description: String,
    /// Simulated time, s.
    pub duration_s: f64,
    /// What errors are distances from.
    pub reference: String,
    /// What that was checked by.
    pub checked_by: String,
    /// How far the two are apart, relative.
    pub apart: f64,
    /// One for each method.
    pub curves: Vec<Curve>,
    /// One for each method of other simulators, where these were asked for.
    pub peers: Vec<Curve>,
    /// Methods that do not play it.
    pub omitted: Vec<Omission>,
}

/// Why there is no survey.
#[derive(Debug, thiserror::Error)]
pub enum SurveyError {
    /// The problem.
    #[error(transparent)]
    Problem(#[from] CatalogueError),
    /// Its reference.
    #[error(transparent)]
    Reference(#[from] NoReference),
    /// A file of finished work.
    #[error("{}: {reason}", path.display())]
    File {
        /// Which one.
        path: PathBuf,
        /// The system's reason.
        reason: String,
    },
}

/// Surveys a problem of the chart; each method is kept in a file of the folder as soon as it is finished, and
/// taken up from there by the same program. `done` hears of each. `peers` are other simulators to measure beside
/// them, if they are asked for; where they are not there, the survey says so.
///
/// # Errors
/// A [`SurveyError`].
pub fn survey(
    name: &str,
    effort: &Effort,
    peers: Option<&Result<Arc<Mujoco>, NoMujoco>>,
    folder: &Path,
    program: &[u8],
    done: &dyn Fn(&str),
) -> Result<Survey, SurveyError> {
    let mut problem = problem(name)?;
    let mut hasher = DefaultHasher::new();
    (program, name, format!("{effort:?}")).hash(&mut hasher);
    let store = Store { folder, fingerprint: format!("{:016x}", hasher.finish()) };
    let exact: Reference = match store.kept(&format!("{name}-reference"))? {
        Some(exact) => exact,
        None => {
            let found = reference(&problem, effort.most_evaluations)?;
            store.keep(&format!("{name}-reference"), &found)?;
            found
        }
    };
    done("reference");
    let found = |contender: &Contender| -> Result<Curve, SurveyError> {
        let part = format!("{name}-{}", contender.name);
        let curve = match store.kept(&part)? {
            Some(curve) => curve,
            None => {
                let foretold_s = (contender.foretell)();
                let curve = Curve { foretold_s, ..sweep(&problem, contender, &exact, effort) };
                store.keep(&part, &curve)?;
                curve
            }
        };
        done(&contender.name);
        Ok(curve)
    };
    let curves: Vec<Curve> = problem.contenders.iter().map(found).collect::<Result<_, _>>()?;
    let others = match peers {
        None => Ok(Vec::new()),
        Some(Ok(mujoco)) => peer_contenders(&problem, mujoco),
        Some(Err(error)) => {
            Err(Omission { method: "MuJoCo".to_owned(), reason: error.to_string() })
        }
    };
    let peers = match others {
        Ok(others) => others.iter().map(found).collect::<Result<_, _>>()?,
        Err(omission) => {
            problem.omitted.push(omission);
            Vec::new()
        }
    };
    Ok(Survey {
        problem: problem.name,
        description: problem.description,
        duration_s: problem.span.duration_s,
        reference: exact.by,
        checked_by: exact.checked_by,
        apart: exact.apart,
        curves,
        peers,
        omitted: problem.omitted,
    })
}

/// Finished work in files.
struct Store<'a> {
    folder: &'a Path,
    /// Of the program and the rules: another's work may have come about otherwise.
    fingerprint: String,
}

#[derive(Serialize, Deserialize)]
struct Kept<T> {
    fingerprint: String,
    work: T,
}

impl Store<'_> {
    fn path(&self, part: &str) -> PathBuf {
        self.folder.join(format!("{part}.json"))
    }

    /// Nothing where there is no file, or one of another program.
    fn kept<T: DeserializeOwned>(&self, part: &str) -> Result<Option<T>, SurveyError> {
        let path = self.path(part);
        let text = match std::fs::read_to_string(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(SurveyError::File { path, reason: error.to_string() }),
        };
        // A file of another program may have another form.
        let kept = serde_json::from_str::<Kept<T>>(&text).ok();
        Ok(kept.filter(|kept| kept.fingerprint == self.fingerprint).map(|kept| kept.work))
    }

    /// At once or not at all.
    fn keep<T: Serialize>(&self, part: &str, work: &T) -> Result<(), SurveyError> {
        let path = self.path(part);
        let kept = Kept { fingerprint: self.fingerprint.clone(), work };
        let error = |error: &dyn std::fmt::Display| SurveyError::File {
            path: path.clone(),
            reason: error.to_string(),
        };
        let text = serde_json::to_string_pretty(&kept).map_err(|e| error(&e))?;
        std::fs::create_dir_all(self.folder).map_err(|e| error(&e))?;
        write_text(&path, &text).map_err(|e| error(&e))
    }
}

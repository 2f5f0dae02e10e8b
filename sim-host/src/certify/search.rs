//! The search for failures of a study in which no sample has failed.

use super::certificate::{Nearest, Searched, nearest};
use super::cross_entropy::{Effort, in_cube, search};
use super::row::Row;
use super::study::{Study, StudyError};
use super::workers::on_all;
use std::sync::atomic::AtomicBool;
use surefoot_sim::closed_loop::Scalar;

/// Numbers of its samples begin here, beyond those of any study.
const FIRST: u64 = 1 << 40;

impl Effort {
    /// Of so many runs: half of them in rounds, five at most, half for the estimate.
    pub fn of_runs(runs: usize) -> Self {
        Self { per_round: runs.div_ceil(10), rounds: 5, estimate: runs.div_ceil(2) }
    }

    /// Runs at most.
    pub fn most_runs(&self) -> usize {
        self.per_round * self.rounds + self.estimate
    }
}

/// Searches, on so many processors; `done` hears of each run. `None` if it was stopped.
///
/// # Errors
/// [`StudyError::Sample`] for a sample whose scene is refused.
pub fn search_failures(
    study: &Study,
    scalar: Scalar,
    (effort, confidence): (&Effort, f64),
    (workers, stop): (usize, &AtomicBool),
    done: &mut (dyn FnMut() + Send),
) -> Result<Option<(Searched, Vec<Nearest>)>, StudyError> {
    /// Why a batch has not all results.
    enum Ended {
        Stopped,
        Refused(StudyError),
    }
    let mut failed: Vec<(Row, Vec<f64>)> = Vec::new();
    let mut reserves = |first: usize, batch: &[Vec<f64>]| {
        let items: Vec<(u64, Vec<f64>)> = batch
            .iter()
            .enumerate()
            .map(|(k, z)| (FIRST + (first + k) as u64, in_cube(z)))
            .collect();
        let work = |(sample, point): &(u64, Vec<f64>)| study.run_at(*sample, point, scalar);
        let mut each = |_: &Row| {
            done();
            Ok(())
        };
        let rows = on_all(&items, workers, stop, &work, &mut each).map_err(Ended::Refused)?;
        let rows: Option<Vec<Row>> = rows.into_iter().collect();
        let rows = rows.ok_or(Ended::Stopped)?;
        let reserves = rows.iter().map(|row| row.reserve).collect();
        let with_points = rows.into_iter().zip(items).map(|(row, (_, point))| (row, point));
        failed.extend(with_points.filter(|(row, _)| row.is_failure()));
        Ok(reserves)
    };
    let seed = study.definition().seed;
    let found = search(study.coordinates().len(), effort, (seed, confidence), &mut reserves);
    let found = match found {
        Ok(found) => found,
        Err(Ended::Stopped) => return Ok(None),
        Err(Ended::Refused(error)) => return Err(error),
    };
    let searched = Searched {
        runs: found.runs,
        failures: found.failures.len(),
        failure_probability: found.probability,
        rounds: found.rounds,
    };
    Ok(Some((searched, nearest(study, failed))))
}

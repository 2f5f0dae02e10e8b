//! All limits of a scene, on all processors.

use super::cell::Cell;
use super::criterion::Criterion;
use super::quantity::Quantity;
use super::resume::{Store, StoreError};
use super::trial::{Footing, Loop, Trial};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use surefoot_sim::scene::{Scene, SceneError};

/// Why a survey has stopped. What was finished before is kept.
#[derive(Debug, thiserror::Error)]
pub enum SurveyError {
    /// A value that the scene's check refuses.
    #[error("{0}")]
    Scene(#[from] SceneError),
    /// Finished cells could not be read or kept.
    #[error("{0}")]
    Store(#[from] StoreError),
}

/// What is sought.
#[derive(Clone, Copy, Debug)]
pub struct Survey<'a> {
    /// Of which scene.
    pub scene: &'a Scene,
    /// In which quantities; those that the scene has not are left out.
    pub quantities: &'a [Quantity],
    /// In which loops.
    pub loops: &'a [Loop],
    /// What works.
    pub criterion: Criterion,
}

impl Survey<'_> {
    /// The limits that are sought, in the order of the table.
    pub fn work(&self) -> Vec<(Quantity, Footing, Loop)> {
        let footings = Footing::of(self.scene);
        self.quantities
            .iter()
            .filter(|quantity| quantity.ladder(self.scene).is_some())
            .flat_map(|quantity| footings.iter().map(|footing| (*quantity, *footing)))
            .flat_map(|(quantity, footing)| {
                self.loops.iter().map(move |control| (quantity, footing, *control))
            })
            .collect()
    }

    /// Those of them that are not among `known`.
    pub fn missing(&self, known: &[Cell]) -> Vec<(Quantity, Footing, Loop)> {
        let mut work = self.work();
        work.retain(|cell| position(known, cell).is_none());
        work
    }

    /// Finds all limits that the store has not, and keeps each there as soon as it is found; `done` hears
    /// of each, of how many. The result does not depend on what was there before.
    ///
    /// # Errors
    /// The first error met; no other limit is begun then.
    pub fn find(
        &self,
        store: &Store,
        done: &(dyn Fn(usize, usize) + Sync),
    ) -> Result<Vec<Cell>, SurveyError> {
        let work = self.work();
        let known = store.finished()?;
        let missing = self.missing(&known);
        let known = Mutex::new((known, None));
        let next = AtomicUsize::new(0);
        let found_before = work.len() - missing.len();
        done(found_before, work.len());
        let finished = AtomicUsize::new(found_before);
        let workers = std::thread::available_parallelism().map_or(1, usize::from);
        std::thread::scope(|scope| {
            for _ in 0..workers.min(missing.len()) {
                scope.spawn(|| {
                    while let Some(cell) = missing.get(next.fetch_add(1, Ordering::Relaxed)) {
                        let found = self.cell(*cell);
                        let Ok(mut known) = known.lock() else { break };
                        let (cells, error) = &mut *known;
                        let kept = found.map_err(SurveyError::from).and_then(|found| {
                            cells.extend(found);
                            Ok(store.keep(cells)?)
                        });
                        if let Err(why) = kept {
                            error.get_or_insert(why);
                            next.store(missing.len(), Ordering::Relaxed);
                            break;
                        }
                        done(finished.fetch_add(1, Ordering::Relaxed) + 1, work.len());
                    }
                });
            }
        });
        // A thread that panicked has taken the whole program with it.
        let (cells, error) = known.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
        match error {
            Some(error) => Err(error),
            None => Ok(work
                .iter()
                .filter_map(|cell| Some(cells[position(&cells, cell)?].clone()))
                .collect()),
        }
    }

    fn cell(
        &self,
        (quantity, footing, control): (Quantity, Footing, Loop),
    ) -> Result<Option<Cell>, SceneError> {
        let Self { scene, criterion, .. } = *self;
        Cell::find(&Trial { scene, quantity, footing, control, criterion })
    }
}

fn position(cells: &[Cell], wanted: &(Quantity, Footing, Loop)) -> Option<usize> {
    cells.iter().position(|cell| (cell.quantity, cell.footing, cell.control) == *wanted)
}

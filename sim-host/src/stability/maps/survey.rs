//! All columns of all maps, on all processors.

use super::column::{Column, Map};
use crate::stability::store::{MapStore, PartStoreError, Parts};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Finds all columns that the store has not, and keeps each there as soon as it is found; `done` hears of
/// each, of how many. The result, by map, does not depend on what was there before.
///
/// # Errors
/// The first error met; no other column is begun then.
pub fn survey(
    maps: &[Map],
    store: &MapStore,
    done: &(dyn Fn(usize, usize) + Sync),
) -> Result<Vec<Vec<Column>>, PartStoreError> {
    let known = store.finished()?;
    let work: Vec<(usize, usize, f64)> = maps
        .iter()
        .enumerate()
        .flat_map(|(map, made)| made.x.values().enumerate().map(move |(i, x)| (map, i, x)))
        .collect();
    let missing: Vec<_> = work
        .iter()
        .filter(|(map, column, _)| {
            known.get(maps[*map].name).is_none_or(|columns| !columns.contains_key(column))
        })
        .collect();
    let found_before = work.len() - missing.len();
    done(found_before, work.len());
    let known: Mutex<(Parts<Column>, Option<PartStoreError>)> = Mutex::new((known, None));
    let (next, finished) = (AtomicUsize::new(0), AtomicUsize::new(found_before));
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..workers.min(missing.len()) {
            scope.spawn(|| {
                while let Some((map, number, x)) = missing.get(next.fetch_add(1, Ordering::Relaxed))
                {
                    let column = maps[*map].column(*x);
                    let Ok(mut known) = known.lock() else { break };
                    let (columns, error) = &mut *known;
                    columns.entry(maps[*map].name.to_owned()).or_default().insert(*number, column);
                    if let Err(why) = store.keep(columns) {
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
    let (mut columns, error) =
        known.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    match error {
        Some(error) => Err(error),
        None => Ok(maps
            .iter()
            .map(|map| columns.remove(map.name).unwrap_or_default().into_values().collect())
            .collect()),
    }
}

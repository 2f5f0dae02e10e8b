//! Work on all processors, whose results do not depend on their number.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// So many as there are processors.
pub fn all_processors() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// Does `work` on all items, in their order or not; `each` hears of each result as soon as it is there, one after the
/// other. Where `stop` was set meanwhile, items that had not begun are missing.
///
/// # Errors
/// The first error of either; what had begun is finished, nothing else begins.
pub fn on_all<T: Sync, R: Send, E: Send>(
    items: &[T],
    workers: usize,
    stop: &AtomicBool,
    work: &(dyn Fn(&T) -> Result<R, E> + Sync),
    each: &mut (dyn FnMut(&R) -> Result<(), E> + Send),
) -> Result<Vec<Option<R>>, E> {
    let next = AtomicUsize::new(0);
    let results: Vec<Option<R>> = items.iter().map(|_| None).collect();
    let shared = Mutex::new((results, each, None));
    std::thread::scope(|scope| {
        for _ in 0..workers.clamp(1, items.len().max(1)) {
            scope.spawn(|| {
                while !stop.load(Ordering::Relaxed) {
                    let number = next.fetch_add(1, Ordering::Relaxed);
                    let Some(item) = items.get(number) else { break };
                    let result = work(item);
                    let Ok(mut shared) = shared.lock() else { break };
                    let (results, each, error) = &mut *shared;
                    match result.and_then(|result| each(&result).map(|()| result)) {
                        Ok(result) => results[number] = Some(result),
                        Err(why) => {
                            error.get_or_insert(why);
                            next.store(items.len(), Ordering::Relaxed);
                            break;
                        }
                    }
                }
            });
        }
    });
    // A thread that panicked has taken the whole program with it.
    let (results, _, error) = shared.into_inner().unwrap_or_else(PoisonError::into_inner);
    error.map_or(Ok(results), Err)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_are_in_the_order_of_the_items() {
        let items: Vec<u64> = (0..100).collect();
        for workers in [1, 2, 7] {
            let mut heard = 0;
            let mut each = |_: &u64| {
                heard += 1;
                Ok::<_, ()>(())
            };
            let stop = AtomicBool::new(false);
            let results = on_all(&items, workers, &stop, &|x| Ok(x * x), &mut each).expect("done");
            assert!(results.iter().zip(&items).all(|(r, x)| *r == Some(x * x)));
            assert_eq!(heard, 100);
        }
    }

    #[test]
    fn an_error_ends_it_and_a_stop_leaves_gaps() {
        let items: Vec<u64> = (0..100).collect();
        let go = AtomicBool::new(false);
        let work = |x: &u64| if *x == 5 { Err("five") } else { Ok(*x) };
        assert_eq!(on_all(&items, 2, &go, &work, &mut |_| Ok(())), Err("five"));
        let stop = AtomicBool::new(true);
        let none = on_all(&items, 2, &stop, &|x| Ok::<_, ()>(*x), &mut |_| Ok(())).expect("done");
        assert!(none.iter().all(Option::is_none));
    }
}

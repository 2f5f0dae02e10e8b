//! Measurements by a sender's clock that is off, late, or begins anew.

use proptest::prelude::*;
use surefoot_firmware::freshness::{Freshness, Stale};

const PERIOD: u32 = 1000;
/// Clocks by crystals, with room.
const DRIFT: u32 = 1024;

/// Measurements at 1 kHz by a clock that is off by `ppm`, each on its way for `transit(n)` µs.
fn stream(
    freshness: &mut Freshness,
    start: (u32, u32),
    ppm: i64,
    transit: impl Fn(u32) -> u32,
    count: u32,
) -> Vec<Result<(), Stale>> {
    (0..count)
        .map(|number| {
            let taken = i64::from(number) * i64::from(PERIOD);
            let arrived = taken + i64::from(transit(number));
            let by_sender = start.0.wrapping_add((taken + taken * ppm / 1_000_000) as u32);
            freshness.accept(by_sender, start.1.wrapping_add(arrived as u32))
        })
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    /// Clocks that begin anywhere, and go round on the way, with up to ±900 ppm between them.
    #[test]
    fn prompt_measurements_are_fresh(
        start in any::<(u32, u32)>(),
        ppm in -900_i64..900,
        jitter in 0_u32..PERIOD,
    ) {
        let mut freshness = Freshness::new(PERIOD, DRIFT);
        let transit = |number: u32| 300 + number.wrapping_mul(0x9e37_79b9) % (jitter + 1);
        for result in stream(&mut freshness, start, ppm, transit, 20_000) {
            prop_assert_eq!(result, Ok(()));
        }
    }

    /// A queue that holds measurements back: those that have waited for longer than a period are
    /// refused, and once it is empty they are fresh again.
    #[test]
    fn measurements_that_waited_are_refused(
        start in any::<(u32, u32)>(),
        ppm in -100_i64..100,
        wait in 2 * PERIOD..50 * PERIOD,
    ) {
        let mut freshness = Freshness::new(PERIOD, DRIFT);
        let transit = |number: u32| if (500..600).contains(&number) { 300 + wait } else { 300 };
        let results = stream(&mut freshness, start, ppm, transit, 1000);
        for (number, result) in results.iter().enumerate() {
            let is_late = (500..600).contains(&number);
            prop_assert_eq!(matches!(result, Err(Stale::Late(_))), is_late, "{}: {:?}", number, result);
        }
    }
}

/// A queue that grows by two per cent of the time is known within 0.1 s: one period, at 2 % less 0.2 %
/// for what clocks may differ, after 56 ms.
#[test]
fn a_growing_queue_is_found() {
    let mut freshness = Freshness::new(PERIOD, DRIFT);
    let results = stream(&mut freshness, (0, 0), 0, |number| 300 + number * PERIOD / 50, 200);
    let first = results.iter().position(Result::is_err).expect("it is found");
    println!("at measurement {first}");
    assert!((50..60).contains(&first), "{first}");
    assert!(results[first..].iter().all(Result::is_err), "and stays late");
}

#[test]
fn a_measurement_that_comes_again_is_none() {
    let mut freshness = Freshness::new(PERIOD, DRIFT);
    assert_eq!(freshness.accept(5000, 100), Ok(()));
    assert_eq!(freshness.accept(5000, 1100), Err(Stale::Repeated));
    assert_eq!(freshness.accept(4000, 2100), Err(Stale::Repeated));
    assert_eq!(freshness.accept(8000, 3100), Ok(()));
    // Another sender's clock.
    freshness.forget();
    assert_eq!(freshness.accept(10, 4100), Ok(()));
}

//! What `chart stability` foretells beside what it finds, all of it together.

use super::maps::{check, file};
use std::sync::atomic::{AtomicUsize, Ordering};
use surefoot_host::stability::maps::{maps, survey, tally, tell};
use surefoot_host::stability::{
    Agreement, Limit, MapStore, RATIO, ScanStore, Tally, all_problems, problems, scan_problems,
};

/// Every cell of every map, and every longest step, ends in a value or a typed failure, and no forecast is more than
/// a tenth too long. The scan is that of the chart, maps have five cells a side.
///
/// May fall short of nine of ten within a factor of two by one in 156 (the chart: 338 of 381). Forecasts of the
/// energy-momentum method are short so that none is unsafe; those of Runge–Kutta with projection sum up losses as
/// if they did not slow down as the motion loses what is fast in it.
#[test]
fn no_forecast_is_unsafe() {
    let (problems, maps) =
        (all_problems().expect("the scenes as shipped"), maps(5).expect("the scenes as shipped"));
    let limits = ScanStore::new(&file("all-limits.json"), &problems, RATIO, b"all");
    let columns = MapStore::new(&file("all-columns.json"), &maps, b"all");
    limits.forget().expect("a file that may go");
    columns.forget().expect("a file that may go");
    let scan = scan_problems(&problems, RATIO, &limits, &|_, _| {}).expect("a folder");
    let found = survey(&maps, &columns, &|_, _| {}).expect("a folder");
    for limit in &scan.limits {
        assert_eq!(limit.fails_from_s.is_some(), limit.kind.is_some(), "{limit:?}");
        let agreement = limit.agreement();
        if !agreement.is_near() || agreement.is_unsafe() {
            println!("{}, {}: {agreement:?}", limit.problem, limit.method);
        }
    }
    let mut all = vec![("longest steps", scan.tally())];
    for (map, columns) in maps.iter().zip(&found) {
        check(map, columns);
        println!("{}: {}", map.name, tell(map, columns));
        all.push((map.name, tally(map, columns)));
    }
    for (name, tally) in &all {
        println!("{name}: {}", tally.words());
    }
    let all: Tally = all.into_iter().map(|(_, tally)| tally).sum();
    println!("in all: {}", all.words());
    assert_eq!(all.forecasts, scan.limits.len() + maps.len() * 5);
    assert!(all.within_a_factor_of_two >= 140, "{}", all.words());
    assert_eq!(all.unsafe_by_more_than_a_tenth, 0, "{}", all.words());
    limits.forget().expect("a file that may go");
    columns.forget().expect("a file that may go");
}

/// The rule itself.
#[test]
fn the_rule_counts_what_it_says() {
    let of = |all: &[Agreement]| all.iter().copied().collect::<Tally>();
    let mut all = vec![Agreement::Ratio(1.5); 9];
    all.push(Agreement::TooCautious);
    assert!(of(&all).holds(), "nine of ten");
    all.push(Agreement::Ratio(2.1));
    assert!(!of(&all).holds(), "nine of eleven");
    assert!(of(&[Agreement::Ratio(0.91), Agreement::NoneWorks, Agreement::Unlimited]).holds());
    for unsafe_side in [Agreement::Ratio(0.9), Agreement::TooBold] {
        let with = [vec![Agreement::Unlimited; 20], vec![unsafe_side]].concat();
        assert_eq!(of(&with).unsafe_by_more_than_a_tenth, 1);
        assert!(!of(&with).holds(), "{unsafe_side:?}");
    }
}

/// What is there is taken up; what another program has found is not; a second run finds the same to the last bit.
#[test]
fn a_scan_is_taken_up_again_and_finds_the_same() {
    let mut problems = problems();
    problems.retain(|problem| ["planet", "elastic-pendulum"].contains(&problem.name));
    let path = file("scan.json");
    let store = ScanStore::new(&path, &problems, 1.1, b"a program");
    store.forget().expect("a file that may go");
    let made = AtomicUsize::new(0);
    let count = |_, _| {
        made.fetch_add(1, Ordering::Relaxed);
    };
    let first = scan_problems(&problems, 1.1, &store, &count).expect("a folder").limits;
    let calls_of_a_whole_scan = made.swap(0, Ordering::Relaxed);
    let mut known = store.finished().expect("limits");
    let some = known.get_mut("planet").expect("scanned");
    let lost: Vec<usize> = some.keys().copied().step_by(2).collect();
    some.retain(|number, _| !lost.contains(number));
    store.keep(&known).expect("a folder");
    let again = scan_problems(&problems, 1.1, &store, &count).expect("a folder").limits;
    assert_eq!(bits(&first), bits(&again));
    let calls = made.into_inner();
    assert!(calls > lost.len() && calls < calls_of_a_whole_scan, "{calls}");
    let other = ScanStore::new(&path, &problems, 1.1, b"another program");
    assert!(other.finished().expect("a file").is_empty());
    let finer = ScanStore::new(&path, &problems, 1.05, b"a program");
    assert!(finer.finished().expect("a file").is_empty(), "of another ratio");
    store.forget().expect("a file that may go");
}

fn bits(limits: &[Limit]) -> Vec<[Option<u64>; 4]> {
    let of = |limit: &Limit| {
        [limit.works_to_s, limit.fails_from_s, limit.longest_s, limit.forecast_s]
            .map(|step_s| step_s.map(f64::to_bits))
    };
    limits.iter().map(of).collect()
}

/// Columns of a loop, of a floor and of a method: bisections end at the same bits, and forecasts do.
#[test]
fn columns_come_out_the_same_again() {
    let maps = maps(4).expect("the scenes as shipped");
    for name in [
        "delay-rate-experiment-1",
        "step-stiffness-biped-variational",
        "step-speed-pendulum-rattle",
    ] {
        let map = maps.iter().find(|map| map.name == name).expect("there");
        let x = map.x.value(2.0);
        let (first, second) = (map.column(x), map.column(x));
        assert_eq!(first, second, "{name}");
        let bits = |y: Option<f64>| y.map(f64::to_bits);
        assert_eq!(bits(first.works_to), bits(second.works_to), "{name}");
        assert_eq!(bits(first.fails_from), bits(second.fails_from), "{name}");
        assert!(first.works_to.is_some(), "{name} has an edge: {first:?}");
    }
}

//! Maps in two parameters: every cell ends in a value or a typed failure, and edges are where searches find
//! them.

use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use surefoot_host::stability::maps::{Column, Foretold, Outcome, maps, survey, tell};
use surefoot_host::stability::{MapStore, Problem, scan_one};
use surefoot_mechanics::integrators::Method;
use surefoot_mechanics::systems::FreeRigidBody;

/// Where this process keeps what charts are made of.
pub fn file(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("surefoot-maps-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    folder.join(name)
}

/// A map's columns are whole, and say nothing that is no number.
pub fn check(map: &surefoot_host::stability::maps::Map, columns: &[Column]) {
    assert_eq!(columns.len(), map.x.cells, "{}", map.name);
    for column in columns {
        assert_eq!(column.cells.len(), map.y.cells, "{}", map.name);
        let numbers = [column.works_to, column.fails_from];
        assert!(numbers.iter().flatten().all(|y| y.is_finite()), "{}: {column:?}", map.name);
        if let Foretold::At(at) = column.foretold {
            assert!(at.is_finite() && at >= 0.0, "{}: {column:?}", map.name);
        }
        // The edge agrees with the cells.
        let first = column.cells.iter().position(|cell| *cell != Outcome::Works);
        assert_eq!(first.is_some(), column.fails_from.is_some(), "{}: {column:?}", map.name);
        if let (Some(works), Some(fails)) = (column.works_to, column.fails_from) {
            assert!(works < fails, "{}: {column:?}", map.name);
        }
    }
    let says = tell(map, columns);
    assert!(!says.contains("NaN") && !says.contains("inf"), "{says}");
}

/// What is there is taken up; what another program has found is not; both lead to the same.
#[test]
fn maps_are_taken_up_again() {
    let mut maps = maps(3).expect("the scenes as shipped");
    maps.retain(|map| map.name.starts_with("step-speed-body"));
    let path = file("taken-up.json");
    let store = MapStore::new(&path, &maps, b"a program");
    store.forget().expect("a file that may go");
    let first = survey(&maps, &store, &|_, _| {}).expect("a folder");
    // Two columns get lost.
    let mut known = store.finished().expect("columns");
    let some = known.values_mut().next().expect("a map");
    some.remove(&0);
    some.remove(&2);
    store.keep(&known).expect("a folder");
    let made = AtomicUsize::new(0);
    let count = |_, _| {
        made.fetch_add(1, Ordering::Relaxed);
    };
    let again = survey(&maps, &store, &count).expect("a folder");
    assert_eq!(first, again);
    // The call before the first column is one of them.
    assert_eq!(made.into_inner(), 1 + 2);
    let other = MapStore::new(&path, &maps, b"another program");
    assert!(other.finished().expect("a file").is_empty());
    std::fs::write(&path, "{").expect("a file");
    assert!(store.finished().is_err_and(|error| error.to_string().contains("--fresh")));
    store.forget().expect("a file that may go");
}

/// A column's edge is what a scan of the same problem finds.
#[test]
fn edges_are_where_scans_find_them() {
    let maps = maps(8).expect("the scenes as shipped");
    for (name, method) in [
        ("step-speed-body-variational", Method::Variational),
        ("step-speed-body-runge-kutta-4", Method::RungeKutta4Projected),
    ] {
        let map = maps.iter().find(|map| map.name == name).expect("there");
        let speed = map.x.value(4.0);
        let column = map.column(speed);
        let omega = [0.0, 0.6 * speed, 0.8 * speed];
        let problem = Problem::free_body("body", "the same", FreeRigidBody::PRINTED, omega);
        let limit = scan_one(&problem, method, 1.02).expect("made for it");
        let (of_map, of_scan) = (column.works_to.expect("a limit"), limit.works_to_s.expect("one"));
        println!("{name}: {of_map:.4} s in the map, {of_scan:.4} s by a scan");
        assert!((of_map / of_scan).ln().abs() < 0.04, "{name}: {of_map}, {of_scan}");
        assert_eq!(column.foretold, Foretold::At(limit.forecast_s.expect("a forecast")));
    }
}

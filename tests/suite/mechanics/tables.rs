//! Tables 2.1 and 2.2, and what is drawn of them.

use surefoot_host::experiments::{Comparison, double_pendulum, free_body};

/// Figures that are farther from the printed ones than asked for.
fn missed(rows: &[Comparison]) -> Vec<&str> {
    rows.iter().filter(|row| row.met == Some(false)).map(|row| row.figure.as_str()).collect()
}

/// All four printed digits; at 1e-4 1 % of the energy.
#[test]
fn table_2_1_is_reproduced() {
    let runs = free_body::Runs::new().expect("all steps are made");
    let rows = runs.table_2_1();
    assert_eq!(rows.iter().filter(|row| row.met.is_some()).count(), 10);
    assert_eq!(missed(&rows), [""; 0]);
    for figure in runs.figures() {
        for row in figure.rows.iter().filter(|row| row.figure.starts_with("slope from")) {
            assert!(row.relative_difference.is_some_and(|d| d.abs() < 1e-3), "{row:?}");
        }
    }
}

/// To 0.4 % but for two rows at 1e-4, by 0.6 and 1.0 %: known, and said by `surefoot reproduce`. Other
/// initial values that round to the printed ones do not mend them; the round-off of SHAKE in positions
/// changes them by as much.
#[test]
fn table_2_2_is_reproduced() {
    let runs = double_pendulum::Runs::new().expect("all steps are made");
    let rows = runs.table_2_2();
    assert!(rows.iter().all(|row| row.met.is_some()));
    let known = ["DVP: position error, h = 1e-4 s", "DVP: energy error, h = 1e-4 s"];
    assert_eq!(missed(&rows), known);
    for row in rows.iter().filter(|row| known.contains(&row.figure.as_str())) {
        assert!(row.relative_difference.is_some_and(|d| d.abs() < 0.011), "{row:?}");
    }
}

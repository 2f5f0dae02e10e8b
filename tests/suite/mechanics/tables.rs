//! Tables 2.1 and 2.2.

use surefoot_sim::experiments::{Comparison, table_2_1, table_2_2};

/// Relative difference of a row, by its name.
fn difference(rows: &[Comparison], figure: &str) -> f64 {
    let row = rows.iter().find(|row| row.figure == figure).expect(figure);
    row.relative_difference.expect("a printed value").abs()
}

/// To the last printed digit but at 1e-4, where the printed energy is the round-off of its day.
#[test]
fn table_2_1_is_reproduced() {
    let rows = table_2_1().expect("all steps are made");
    for h in ["1e-3", "1e-2", "1e-1"] {
        for what in ["quaternion error", "energy error", "momentum error"] {
            // Half a unit in the last of four digits is at most 5e-4; of 3.648 it is 1.4e-4.
            let difference = difference(&rows, &format!("{what}, h = {h} s"));
            assert!(difference < 3e-4, "{what}, {h}: {difference}");
        }
    }
    assert!(difference(&rows, "energy error, h = 1e-4 s") < 0.01);
    assert!(difference(&rows, "momentum error, h = 1e-4 s") < 1e-3);
}

/// From the rounded initial values that are printed. At 1e-4, where the start's error is as large as the
/// method's, the differences are larger.
#[test]
fn table_2_2_is_reproduced() {
    let rows = table_2_2().expect("all steps are made");
    for (h, limit) in [("1e-4", 0.011), ("1e-3", 4e-3), ("1e-2", 4e-3), ("1e-1", 4e-3)] {
        for what in ["position error", "energy error", "momentum error"] {
            let difference = difference(&rows, &format!("DVP: {what}, h = {h} s"));
            assert!(difference < limit, "{what}, {h}: {difference}");
        }
        let energy = rows.iter().find(|r| r.figure == format!("EM: energy error, h = {h} s"));
        assert!(energy.expect("a row").ours < 1e-10);
    }
    for h in ["1e-3", "1e-2", "1e-1"] {
        let difference = difference(&rows, &format!("EM: position error, h = {h} s"));
        assert!(difference < 4e-3, "{h}: {difference}");
    }
}

//! Tables and figures of the text.

use crate::program::{folder, said, surefoot};
use serde_json::Value;

/// Tables come as one document each, with the reading they were made in.
#[test]
fn tables_are_reproduced_as_json() {
    let folder = folder("reproduce");
    let (status, stdout, stderr) = said(&surefoot(&folder, &["reproduce", "table-2.1", "--json"]));
    assert_eq!(status, Some(0), "{stderr}");
    let document: Value = serde_json::from_str(&stdout).expect("one document");
    assert_eq!(document["figure"], "table-2.1");
    assert!(document["reading"].as_str().is_some_and(|reading| reading.contains("301")));
    let rows = document["rows"].as_array().expect("rows");
    assert_eq!(rows.len(), 12);
    for row in rows {
        assert!(row["ours"].is_number() && row["printed"].is_number());
        // Nothing is relative to a printed zero.
        assert_eq!(row["relative_difference"].is_null(), row["printed"] == 0.0);
    }
    let (status, _, stderr) = said(&surefoot(&folder, &["reproduce", "table-9.9"]));
    assert_eq!(status, Some(2));
    assert!(stderr.contains("table-2.1"), "{stderr}");
}

/// Figures of §4.3 are drawn under their numbers, with what the text prints in them.
#[test]
fn figures_of_experiment_1_are_reproduced() {
    let folder = folder("reproduce-figures");
    let (status, stdout, stderr) = said(&surefoot(&folder, &["reproduce", "figure-4.9", "--json"]));
    assert_eq!(status, Some(0), "{stderr}");
    let document: Value = serde_json::from_str(&stdout).expect("one document");
    assert_eq!(document["figure"], "figure-4.9");
    assert!(document["reading"].as_str().is_some_and(|reading| reading.contains("touch-down")));
    assert_eq!(document["rows"][0]["printed"], 1687.0);
    let ours = document["rows"][0]["ours"].as_f64().expect("a number");
    assert!((ours / 1687.0 - 1.0).abs() < 0.01, "{ours} N");
    let file = document["file"].as_str().expect("a path");
    let svg = std::fs::read_to_string(folder.join(file)).expect("written");
    assert!(svg.contains("Figure 4.9, Experiment 1: desired body force"));
}

/// A row of public benchmark problems, as the table's JSON has it, and its files.
#[test]
fn benchmarks_of_others_are_reproduced() {
    let folder = folder("reproduce-benchmarks");
    let row = ["reproduce", "benchmarks", "--quick", "--json", "--row", "a03-andrews"];
    let (status, stdout, stderr) = said(&surefoot(&folder, &row));
    assert_eq!(status, Some(0), "{stderr}");
    let document: Value = serde_json::from_str(&stdout).expect("one document");
    let row = &document["rows"][0];
    assert_eq!((&row["name"], &row["meets"]), (&"a03-andrews".into(), &true.into()));
    for field in ["step_s", "error", "bar"] {
        assert!(row[field].is_number(), "{row}");
    }
    assert!(row["peers"].is_object() && row["measure"].is_string() && row["reference"].is_string());
    let page = std::fs::read_to_string(folder.join("out/reproduce/benchmarks/benchmarks.html"));
    assert!(page.expect("written").contains("<svg"));
    let text = std::fs::read_to_string(folder.join("out/reproduce/benchmarks/a03-andrews.txt"));
    assert!(text.expect("written").starts_with("time\tK1_x"));
    let unknown = ["reproduce", "benchmarks", "--row", "a99"];
    let (status, _, stderr) = said(&surefoot(&folder, &unknown));
    assert_eq!(status, Some(2));
    assert!(stderr.contains("a03-andrews"), "{stderr}");
}

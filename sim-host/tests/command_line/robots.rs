//! Runs of robots, and what they leave.

use crate::program::{changed_scene, folder, said, surefoot};
use serde_json::Value;

#[test]
fn a_run_prints_one_json_document() {
    let folder = folder("json");
    let output = surefoot(
        &folder,
        &["run", "experiment-1-welded", "--duration", "0.1", "--json", "--scalar", "f32"],
    );
    let (status, stdout, _) = said(&output);
    assert_eq!(status, Some(0));
    let document: Value = serde_json::from_str(&stdout).expect("one document and nothing else");
    for key in [
        "scene",
        "integrator",
        "step_s",
        "duration_s",
        "scalar",
        "steps",
        "outcome",
        "failure",
        "wall_s",
        "wall_us_per_step",
        "newton",
        "unknowns_per_step",
        "energy",
        "momentum",
        "constraint_max",
        "peak_torque_nm",
        "desired_force_z_n",
        "final",
        "events",
    ] {
        assert!(document.get(key).is_some(), "the document has no {key}");
    }
    assert_eq!(document["scene"], "experiment-1-welded");
    assert_eq!(document["scalar"], "f32");
    assert_eq!(document["steps"], 50);
    assert_eq!(document["outcome"], "completed");
    assert_eq!(document["failure"], Value::Null);
    for key in ["value", "joint", "time_s"] {
        assert!(!document["peak_torque_nm"][key].is_null(), "peak_torque_nm.{key}");
    }
    for file in document["files"].as_array().expect("a list of files") {
        let path = folder.join(file.as_str().expect("a path"));
        assert!(path.metadata().expect("written").len() > 1000, "{}", path.display());
    }
}

/// What only shows while running: status 1, and the reason in both forms.
#[test]
fn a_run_that_fails_says_why() {
    let folder = folder("failures");
    let straight = "[0.0, 40.0, 0.0, -77.4595, 0.0, 42.4595]\nright";
    let straightened = "[0.0, 0.0, 0.0, 0.0, 0.0, 0.0]\nright";
    let path = changed_scene(
        &folder,
        &[
            (straight, straightened),
            ("position_m = [-0.01, 0.0, 1.10]", "position_m = [0.0, 0.0, 0.9]"),
        ],
    );
    let too_long = ["run", "--integrator", "semi-implicit-euler", "--step", "0.001"];
    let bare = ["--controller", "bare"];
    for (arguments, outcome, kind, words) in [
        (vec!["run", &path], "stopped", "stopped", vec!["leg 0", "straight knee"]),
        (
            [&["run", &path][..], &bare].concat(),
            "failed",
            "controller-fault",
            vec!["leg 0", "straight knee"],
        ),
        (too_long.to_vec(), "stopped", "stopped", vec!["supervisor", "a shorter step: with"]),
        (
            [&too_long[..], &bare].concat(),
            "failed",
            "step",
            vec!["velocity", "a shorter step: with"],
        ),
    ] {
        let (status, stdout, stderr) = said(&surefoot(&folder, &arguments));
        assert_eq!(status, Some(1), "{arguments:?}: {stderr}");
        for word in words {
            assert!(stdout.contains(word), "{arguments:?} says {stdout:?}, without {word:?}");
        }
        let json = [&arguments[..], &["--json"]].concat();
        let (status, stdout, _) = said(&surefoot(&folder, &json));
        assert_eq!(status, Some(1));
        let document: Value = serde_json::from_str(&stdout).expect("one document");
        assert_eq!(document["outcome"], outcome);
        assert_eq!(document["failure"]["kind"], kind);
        let stopped = &document["supervisor"]["stopped"];
        assert_eq!(stopped.as_bool(), (!arguments.contains(&"bare")).then_some(true));
        for key in ["time_s", "where", "advice"] {
            assert!(!document["failure"][key].is_null(), "failure.{key}");
        }
    }
}

/// Results go where the user says, and a place that cannot be written is an error, not a loss.
#[test]
fn results_go_where_they_are_sent() {
    let folder = folder("out");
    let arguments = ["run", "experiment-1-welded", "--duration", "0.01", "--out", "somewhere/else"];
    let (status, _, stderr) = said(&surefoot(&folder, &arguments));
    assert_eq!(status, Some(0), "{stderr}");
    let record = std::fs::read_to_string(folder.join("somewhere/else/record.csv")).expect("there");
    assert_eq!(record.lines().count(), 1 + 6, "a head and a line for each of the six ticks");
    std::fs::write(folder.join("blocked"), "a file").expect("writable");
    let (status, _, stderr) =
        said(&surefoot(&folder, &["run", "--duration", "0.01", "--out", "blocked/folder"]));
    assert_eq!(status, Some(2));
    assert!(stderr.contains("blocked"), "{stderr}");
}

/// A run leaves a page, the record twice, and its figures.
#[test]
fn a_run_leaves_its_report_and_record() {
    let folder = folder("report");
    let (status, _, stderr) = said(&surefoot(&folder, &["run", "--duration", "0.1"]));
    assert_eq!(status, Some(0), "{stderr}");
    let out = folder.join("out/experiment-1");
    let page = std::fs::read_to_string(out.join("report.html")).expect("a page");
    assert!(page.starts_with("<!DOCTYPE html>") && page.trim_end().ends_with("</html>"));
    // Both readings of the first instant.
    assert!(page.contains("torques from t = 0") && page.contains("torques from touch-down"));
    let mcap = std::fs::read(out.join("record.mcap")).expect("a record");
    assert!(mcap.starts_with(b"\x89MCAP0\r\n") && mcap.ends_with(b"\x89MCAP0\r\n"));
    for name in ["record.csv", "joint-angles.svg", "tracking-errors.svg", "ground-forces.svg"] {
        assert!(out.join(name).is_file(), "{name}");
    }
}

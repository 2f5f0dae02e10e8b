//! The binary as its users meet it: exit statuses, one JSON document on stdout, messages that say
//! what, where and what was expected.

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const SCENE: &str = include_str!("../scenes/experiment-1-welded.toml");

/// A folder of this test's own, for scenes and results.
fn folder(test: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(test);
    std::fs::create_dir_all(&folder).expect("a folder below the target directory");
    folder
}

fn surefoot(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_surefoot"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .expect("the program starts")
}

/// Exit status and both streams.
fn said(output: &Output) -> (Option<i32>, String, String) {
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).expect("UTF-8");
    (output.status.code(), text(&output.stdout), text(&output.stderr))
}

/// The scene of the welded feet with some lines changed.
fn changed_scene(folder: &Path, changes: &[(&str, &str)]) -> String {
    let mut scene = SCENE.to_owned();
    for (line, by) in changes {
        assert!(scene.contains(line), "the scene has the line {line}");
        scene = scene.replace(line, by);
    }
    let path = folder.join("pushed.toml");
    std::fs::write(&path, scene).expect("writable");
    path.to_str().expect("UTF-8").to_owned()
}

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

#[test]
fn the_lists_name_what_run_takes() {
    let folder = folder("list");
    let (status, text, _) = said(&surefoot(&folder, &["list"]));
    assert_eq!(status, Some(0));
    let (_, stdout, _) = said(&surefoot(&folder, &["list", "--json"]));
    let document: Value = serde_json::from_str(&stdout).expect("one document");
    for group in ["scenes", "integrators", "robots"] {
        for entry in document[group].as_array().expect("a list") {
            let name = entry["name"].as_str().expect("a name");
            assert!(text.contains(name), "{name} is in both lists");
        }
    }
    assert!(document["scenes"].as_array().expect("a list").len() >= 2);
}

/// Bad usage and input: status 2, a message with the culprit and what was expected, and no file.
#[test]
fn bad_input_is_refused_before_anything_runs() {
    let folder = folder("refused");
    let cases: [(&[&str], &[&str]); 9] = [
        (&["run", "experiment-l"], &["experiment-l", "experiment-1"]),
        (&["run", "no-such-scene.toml"], &["no-such-scene.toml"]),
        (&["run", "--step", "-0.001"], &["step_s", "-0.001", "above zero"]),
        (&["run", "--step", "NaN"], &["step_s", "NaN", "above zero"]),
        (&["run", "--step", "1e-15"], &["step_s", "steps"]),
        (&["run", "--duration", "0"], &["duration_s", "above zero"]),
        (&["run", "--step", "0.0003"], &["rate_hz", "whole number"]),
        (&["run", "--scalar", "f16"], &["f16", "f32"]),
        (&["walk"], &["walk", "Usage"]),
    ];
    for (arguments, words) in cases {
        let (status, stdout, stderr) = said(&surefoot(&folder, arguments));
        assert_eq!(status, Some(2), "{arguments:?}: {stderr}");
        assert!(stdout.is_empty(), "{arguments:?} printed {stdout}");
        for word in words {
            assert!(stderr.contains(word), "{arguments:?} says {stderr:?}, without {word:?}");
        }
    }
    assert!(!folder.join("out").exists(), "nothing was written");
    let (status, stdout, _) = said(&surefoot(&folder, &["run", "experiment-l", "--json"]));
    assert_eq!(status, Some(2));
    let document: Value = serde_json::from_str(&stdout).expect("one document");
    assert_eq!(document["error"]["kind"], "bad-input");
}

/// Scene files that are wrong in one place are refused with that place.
#[test]
fn a_wrong_scene_file_is_refused_at_its_line() {
    let folder = folder("scene-files");
    for (line, by, words) in [
        ("rate_hz = 500.0", "rate_hz = nan", vec!["rate_hz", "NaN"]),
        ("rate_hz = 500.0", "rate_hz = \"fast\"", vec!["rate_hz", "line", "fast"]),
        ("rate_hz = 500.0", "rate_Hz = 500.0", vec!["rate_Hz", "rate_hz"]),
        ("turn_deg = 5.0", "", vec!["turn_deg"]),
        ("duration_s = 3.0", "duration_s = 3.0.0", vec!["line 3"]),
        ("on = \"welded\"", "on = \"clouds\"", vec!["clouds", "welded"]),
        (
            "orientation = [0.99144486,",
            "orientation = [0.5,",
            vec!["set_point.orientation", "norm"],
        ),
        ("name = \"variational\"", "name = \"leapfrog\"", vec!["leapfrog", "semi-implicit"]),
    ] {
        let path = changed_scene(&folder, &[(line, by)]);
        let (status, _, stderr) = said(&surefoot(&folder, &["run", &path]));
        assert_eq!(status, Some(2), "{by:?}: {stderr}");
        assert!(stderr.contains("pushed"), "{by:?}: {stderr} does not name the scene");
        for word in words {
            assert!(stderr.contains(word), "{by:?} says {stderr:?}, without {word:?}");
        }
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
    for (arguments, kind, words) in [
        (vec!["run", &path], "controller-fault", vec!["leg 0", "straight knee"]),
        (
            vec!["run", "--integrator", "semi-implicit-euler", "--step", "0.001"],
            "step",
            vec!["velocity", "limit of stability"],
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
        assert_eq!(document["outcome"], "failed");
        assert_eq!(document["failure"]["kind"], kind);
        for key in ["time_s", "where", "advice"] {
            assert!(!document["failure"][key].is_null(), "failure.{key}");
        }
    }
}

/// A set point that no leg reaches is seen before the run.
#[test]
fn a_set_point_out_of_reach_is_refused() {
    let folder = folder("reach");
    let path = changed_scene(
        &folder,
        &[("position_m = [-0.01, 0.0, 1.10]", "position_m = [-0.01, 0.0, 2.5]")],
    );
    let (status, _, stderr) = said(&surefoot(&folder, &["run", &path]));
    assert_eq!(status, Some(2), "{stderr}");
    for word in ["set_point", "2.5", "reach"] {
        assert!(stderr.contains(word), "{stderr:?} has no {word:?}");
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

/// A firmware that is not there, and a port that is none.
#[test]
fn a_missing_target_is_named() {
    let folder = folder("target");
    for (arguments, words) in [
        (
            ["run", "--controller", "firmware", "--firmware", "no-such.elf"],
            ["no-such.elf", "cargo xtask firmware"],
        ),
        (
            ["run", "--controller", "firmware", "--port", "/dev/no-such-port"],
            ["/dev/no-such-port", "No such file"],
        ),
    ] {
        let (status, stdout, stderr) = said(&surefoot(&folder, &arguments));
        assert_eq!(status, Some(2), "{arguments:?}: {stderr}");
        assert!(stdout.is_empty());
        for word in words {
            assert!(stderr.contains(word), "{stderr:?} has no {word:?}");
        }
    }
}

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

/// Mechanisms run under any method that is made for them, and say what they keep.
#[test]
fn mechanisms_run_and_say_what_they_keep() {
    let folder = folder("mechanisms");
    for (arguments, unknowns, momenta) in [
        (vec!["rigid-body", "--integrator", "lie-group"], 5, true),
        (vec!["spherical-pendulum", "--integrator", "yoshida-4"], 4, true),
        (vec!["n-pendulum", "--links", "4", "--duration", "2"], 16, false),
        (vec!["chain", "--links", "20", "--duration", "1"], 20, false),
        (vec!["biped-flight", "--duration", "0.5"], 18, true),
    ] {
        let all = [&["run"], &arguments[..], &["--json"]].concat();
        let (status, stdout, stderr) = said(&surefoot(&folder, &all));
        assert_eq!(status, Some(0), "{arguments:?}: {stderr}");
        let document: Value = serde_json::from_str(&stdout).expect("one document");
        assert_eq!(document["outcome"], "completed");
        assert_eq!(document["unknowns_per_step"], unknowns);
        assert!(document["newton"]["mean"].as_f64().is_some_and(|mean| mean > 1.0));
        assert!(document["constraint_max"].as_f64().is_some_and(|g| g < 1e-10));
        let drift = document["momentum"]["angular_drift"].as_f64();
        // The n-pendulum begins at rest: nothing to relate a change to.
        assert_eq!(drift.is_some(), momenta);
        assert!(drift.is_none_or(|drift| drift < 1e-12), "{drift:?}");
        let steps = document["steps"].as_u64().expect("a number");
        let record =
            std::fs::read_to_string(folder.join("out").join(arguments[0]).join("record.csv"));
        let lines = record.expect("a record").lines().count() as u64;
        assert!(lines > 500 && lines <= steps + 2, "{lines} lines of {steps} steps");
    }
}

/// A step that is too long is a typed failure with a step that works; what does not go together is
/// refused.
#[test]
fn a_mechanism_that_fails_says_why() {
    let folder = folder("mechanism-failures");
    let too_long = ["run", "rigid-body", "--integrator", "variational", "--step", "0.3", "--json"];
    let (status, stdout, _) = said(&surefoot(&folder, &too_long));
    assert_eq!(status, Some(1));
    let document: Value = serde_json::from_str(&stdout).expect("one document");
    assert_eq!(document["failure"]["kind"], "no-root");
    assert!(document["failure"]["advice"].as_str().is_some_and(|a| a.contains("foretold")));
    let cases: [(&[&str], &[&str]); 12] = [
        (&["chain", "--integrator", "rattle"], &["integrator.name", "variational"]),
        (&["chain", "--links", "0"], &["links", "0", "1 to"]),
        (
            &["chain", "--links", "14", "--integrator", "runge-kutta-4"],
            &["runge-kutta-4", "thirteen bodies"],
        ),
        (&["four-bar", "--integrator", "dormand-prince-8"], &["closed loops"]),
        (&["box-drop", "--integrator", "yoshida-4"], &["yoshida-4", "touch nothing"]),
        (&["chain", "--accuracy", "1"], &["--accuracy", "between 0 and 1"]),
        (&["rigid-body", "--integrator", "rattle"], &["rattle", "natural systems"]),
        (&["n-pendulum", "--integrator", "verlet"], &["verlet", "without constraints"]),
        (&["n-pendulum", "--links", "9"], &["links", "9", "1 to 4"]),
        (&["rigid-body", "--links", "2"], &["--links", "a scene with links"]),
        (&["rigid-body", "--controller", "firmware"], &["no controller"]),
        (&["experiment-1", "--integrator", "rattle"], &["integrator.name", "semi-implicit-euler"]),
    ];
    for (arguments, words) in cases {
        let (status, stdout, stderr) = said(&surefoot(&folder, &[&["run"], arguments].concat()));
        assert_eq!(status, Some(2), "{arguments:?}: {stderr}");
        assert!(stdout.is_empty());
        for word in words {
            assert!(stderr.contains(word), "{arguments:?} says {stderr:?}, without {word:?}");
        }
    }
}

/// A scene that names no method is advised on one; one that says what it was recommended for says so; the command
/// line has the last word on each.
#[test]
fn a_run_says_where_its_method_and_step_come_from() {
    let folder = folder("recommended");
    let whole = include_str!("../scenes/spherical-pendulum.toml");
    let (head, rest) = whole.split_once("[integrator]").expect("a method");
    let (_, mechanism) = rest.split_once("[mechanism]").expect("a mechanism");
    let open =
        format!("{head}[mechanism]{mechanism}").replace("duration_s = 30.0", "duration_s = 1.0");
    let path = folder.join("open.toml");
    std::fs::write(&path, open).expect("writable");
    let open = path.to_str().expect("UTF-8");
    let run = |arguments: &[&str]| -> Value {
        let all = [&["run"], arguments, &["--json"]].concat();
        let (status, stdout, stderr) = said(&surefoot(&folder, &all));
        assert_eq!(status, Some(0), "{arguments:?}: {stderr}");
        serde_json::from_str(&stdout).expect("one document")
    };
    // Arguments, what they make the method and the step, and words of the reason.
    type Case<'a> = (&'a [&'a str], Option<&'a str>, Option<f64>, &'a [&'a str]);
    let cases: [Case<'_>; 6] = [
        (&[open], None, None, &["advised for an error of 1e-4", "when tried"]),
        (&[open, "--integrator", "rattle"], Some("rattle"), None, &["command line", "advised"]),
        (&[open, "--step", "0.01"], None, Some(0.01), &["command line", "advised"]),
        (
            &[open, "--step", "0.01", "--integrator", "shake", "--accuracy", "0.01"],
            Some("shake"),
            Some(0.01),
            &["named on the command line"],
        ),
        (
            &["spherical-pendulum", "--duration", "1"],
            Some("runge-kutta-4-projected"),
            Some(0.02),
            &["recommended for an error of 1e-4"],
        ),
        (
            &["four-bar", "--duration", "1"],
            Some("variational"),
            Some(1e-3),
            &["named by the scene"],
        ),
    ];
    for (arguments, method, step, words) in cases {
        let document = run(arguments);
        assert!(method.is_none_or(|name| document["integrator"] == name), "{document}");
        assert!(step.is_none_or(|h| document["step_s"] == h), "{document}");
        let reason = document["integrator_reason"].as_str().expect("a reason");
        for word in words {
            assert!(reason.contains(word), "{arguments:?}: {reason}");
        }
    }
    // A method of low order needs shorter steps for more.
    let step = |accuracy: &str| {
        let document = run(&[open, "--integrator", "rattle", "--accuracy", accuracy]);
        document["step_s"].as_f64().expect("a step")
    };
    let (coarse, fine) = (step("1e-2"), step("1e-4"));
    assert!((5.0..20.0).contains(&(coarse / fine)), "{coarse} {fine}");
}

/// Values that a mechanism's file may get wrong.
#[test]
fn a_wrong_mechanism_is_refused_with_its_place() {
    let folder = folder("mechanism-files");
    let scenes =
        [include_str!("../scenes/rigid-body.toml"), include_str!("../scenes/n-pendulum.toml")];
    for (scene, line, by, words) in [
        (
            0,
            "inertia_kg_m2 = [1.0, 2.0, 3.0]",
            "inertia_kg_m2 = [1.0, 2.0, 3.1]",
            ["inertia", "sum"],
        ),
        (0, "orientation = [1.0,", "orientation = [0.0,", ["mechanism.orientation", "norm"]),
        (0, "[0.0, 3.0, 4.0]", "[0.0, nan, 4.0]", ["angular_velocity", "finite"]),
        (0, "kind = \"rigid-body\"", "kind = \"jelly\"", ["jelly", "pendulum"]),
        (1, "gravity_m_s2 = 9.81", "gravity_m_s2 = inf", ["gravity", "finite"]),
        (1, "length_m = 0.5", "length_m = -0.5", ["links[0]", "above zero"]),
        (1, "step_s = 2e-2", "step_s = 0.0", ["integrator.step_s", "above zero"]),
        (1, "accuracy = 1e-4", "accuracy = 1.5", ["matters.accuracy", "between"]),
        (1, "duration_s = 20.0", "duration_s = nan", ["duration_s", "above zero"]),
    ] {
        assert!(scenes[scene].contains(line), "{line}");
        let path = folder.join("wrong.toml");
        std::fs::write(&path, scenes[scene].replacen(line, by, 1)).expect("writable");
        let path = path.to_str().expect("UTF-8");
        let (status, _, stderr) = said(&surefoot(&folder, &["run", path]));
        assert_eq!(status, Some(2), "{by}: {stderr}");
        for word in words {
            assert!(stderr.contains(word), "{by:?} says {stderr:?}, without {word:?}");
        }
    }
}

/// Limits of a loop: the same document from a survey, from what it left, and from a fresh one.
#[test]
fn limits_are_charted_and_taken_up_again() {
    let folder = folder("limits");
    let scene =
        changed_scene(&folder, &[("1.10]", "1.165]"), ("duration_s = 3.0", "duration_s = 1.0")]);
    let all = ["chart", "stability", "--scene", &scene, "--only", "set-point-height", "--json"];
    let chart = |more: &[&str]| said(&surefoot(&folder, &[&all, more].concat()));
    let (status, first, messages) = chart(&["--fresh"]);
    assert_eq!(status, Some(0), "{messages}");
    assert!(!messages.contains("taken up"), "{messages}");
    let document: Value = serde_json::from_str(&first).expect("one document and nothing else");
    let limit = &document["limits"][0];
    assert_eq!(limit["quantity"], "set-point-height");
    assert_eq!(limit["footing"], "welded");
    assert!(limit["value"].as_f64().is_some_and(|z| (1.165..1.2).contains(&z)), "{limit}");
    assert_eq!(limit["manner"], "singular leg");
    let (status, second, messages) = chart(&[]);
    assert_eq!((status, &second), (Some(0), &first));
    assert!(messages.contains("1 of 1 limits taken up"), "{messages}");

    for (arguments, word) in [
        (&["chart", "stability", "--scene", "chain"], "nobody controls"),
        (&["chart", "stability", "--scene", "experiment-3"], "no scene"),
        (&["chart", "stability", "--only", "friction"], "--scene"),
    ] {
        let (status, _, stderr) = said(&surefoot(&folder, arguments));
        assert_eq!(status, Some(2));
        assert!(stderr.contains(word), "{stderr}");
    }
}

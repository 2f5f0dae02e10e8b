//! What is refused, and with which words.

use crate::program::{changed_scene, folder, said, surefoot};
use serde_json::Value;

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
        ("rate_hz = 500.0", "rate_hz = nan", vec!["rate_hz = nan", "finite"]),
        ("rate_hz = 500.0", "rate_hz = \"fast\"", vec![".toml:", "controller.rate_hz", "fast"]),
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

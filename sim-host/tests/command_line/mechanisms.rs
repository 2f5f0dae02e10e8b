//! Runs of mechanisms.

use crate::program::{folder, said, surefoot};
use serde_json::Value;

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

/// Bodies and joints are played with the smallest model, or with the one that is asked for; what they do not bear
/// is refused with the reason.
#[test]
fn models_of_mechanisms_are_told_and_chosen() {
    let folder = folder("models");
    for (arguments, model, bodies) in [
        (vec!["hinged-chain"], "planar", 5),
        (vec!["hinged-chain", "--model", "full"], "full", 10),
        (vec!["hinged-chain", "--model", "merged"], "merged", 5),
        (vec!["box-drop"], "single-body", 1),
    ] {
        let all = [&["run"], &arguments[..], &["--duration", "0.05", "--json"]].concat();
        let (status, stdout, stderr) = said(&surefoot(&folder, &all));
        assert_eq!(status, Some(0), "{arguments:?}: {stderr}");
        let document: Value = serde_json::from_str(&stdout).expect("one document");
        assert_eq!(document["model"]["model"], model, "{arguments:?}");
        assert_eq!(document["model"]["bodies"], bodies, "{arguments:?}");
    }
    for (arguments, word) in [
        (vec!["chain", "--model", "planar", "--integrator", "variational"], "not parallel"),
        (vec!["chain", "--model", "planar"], "--integrator variational"),
        (vec!["chain", "--model", "lumped"], "planar or single-body"),
        (vec!["experiment-1", "--model", "planar"], "lumped"),
        (vec!["rigid-body", "--model", "full"], "one model only"),
    ] {
        let (status, _, stderr) = said(&surefoot(&folder, &[&["run"], &arguments[..]].concat()));
        assert_eq!(status, Some(2), "{arguments:?}");
        assert!(stderr.contains(word), "{arguments:?}: {stderr}");
    }
    let (status, stdout, _) =
        said(&surefoot(&folder, &["run", "hinged-chain", "--duration", "0.05"]));
    assert_eq!(status, Some(0));
    assert!(stdout.contains("model: planar, bodies: 5; the motion stays in the plane"), "{stdout}");
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
    assert!(document["failure"]["advice"].as_str().is_some_and(|a| a.contains("(tried)")));
    let cases: [(&[&str], &[&str]); 11] = [
        (&["chain", "--integrator", "rattle"], &["integrator.name", "variational"]),
        (&["chain", "--links", "0"], &["links", "0", "1 to"]),
        (&["box-drop", "--integrator", "dormand-prince-8"], &["touch nothing"]),
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
    let whole = include_str!("../../scenes/spherical-pendulum.toml");
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
    let scenes = [
        include_str!("../../scenes/rigid-body.toml"),
        include_str!("../../scenes/n-pendulum.toml"),
    ];
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
        (1, "duration_s = 20.0", "duration_s = nan", ["duration_s", "finite"]),
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

/// Iterations of a step are those of all its stages: no mean is above the most.
#[test]
fn no_step_takes_fewer_iterations_than_the_mean() {
    let folder = folder("iterations");
    for (scene, method) in [
        ("n-pendulum", "variational"),
        ("n-pendulum", "yoshida-4"),
        ("n-pendulum", "yoshida-6"),
        ("n-pendulum", "rattle"),
        ("n-pendulum", "shake"),
        ("chain", "variational"),
        ("chain", "yoshida-4"),
        ("box-drop", "variational"),
    ] {
        let all = ["run", scene, "--integrator", method, "--step", "2e-3", "--duration", "0.5"];
        let (_, stdout, stderr) = said(&surefoot(&folder, &[&all[..], &["--json"]].concat()));
        let document: Value = serde_json::from_str(&stdout).expect("one document");
        let number = |key: &str| document["newton"][key].as_f64().expect("a number");
        let (mean, most) = (number("mean"), number("max"));
        assert!(mean > 0.0 && mean <= most, "{scene}, {method}: {mean} of {most} {stderr}");
    }
}

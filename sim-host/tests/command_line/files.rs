//! Files and streams: whole or not at all, and no result that is lost without a word.

use crate::program::{folder, said, surefoot};
use serde_json::Value;
use std::fs::read_to_string;
use std::path::Path;
use std::process::{Command, Output, Stdio};

fn document(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout).expect("one document")
}

/// Rows of a record, without its head.
fn rows(record: &Path) -> Vec<Vec<f64>> {
    let text = read_to_string(record).expect("a record");
    let row = |line: &str| line.split(',').map(|x| x.parse().unwrap_or(f64::NAN)).collect();
    text.lines().skip(1).map(row).collect()
}

fn program(folder: &Path, arguments: &[&str]) -> Command {
    let mut program = Command::new(env!("CARGO_BIN_EXE_surefoot"));
    program.args(arguments).current_dir(folder);
    program
}

/// The document and the record tell the time that was reached, which is the scene's or is said to be another.
#[test]
fn the_end_that_is_told_is_the_record_s() {
    let folder = folder("end");
    for (arguments, reached) in [
        (&["run", "four-bar", "--duration", "1", "--step", "0.003"][..], 0.999),
        (&["run", "four-bar", "--duration", "0.5"], 0.5),
        (&["run", "experiment-1-welded", "--duration", "0.0151"], 0.016),
        (
            &[
                "run",
                "rigid-body",
                "--integrator",
                "runge-kutta-4",
                "--duration",
                "1",
                "--step",
                "0.03",
            ],
            0.99,
        ),
    ] {
        let whole = [arguments, &["--json", "--out", "there"]].concat();
        let output = surefoot(&folder, &whole);
        let told = document(&output)["duration_s"].as_f64().expect("a time");
        let last = rows(&folder.join("there/record.csv")).pop().expect("rows");
        assert_eq!(last[0], told, "{arguments:?}");
        assert!((told - reached).abs() < 1e-12, "{arguments:?}: {told}");
        let (_, text, _) = said(&surefoot(&folder, arguments));
        let wanted = document(&output)["requested_duration_s"].as_f64().expect("a time");
        assert_eq!(text.contains("ended at"), (wanted - told).abs() > 1e-9, "{text}");
    }
    for arguments in [["four-bar", "0.0004"], ["experiment-1-welded", "0.0009"]] {
        let [scene, duration] = arguments;
        let (status, _, stderr) = said(&surefoot(&folder, &["run", scene, "--duration", duration]));
        assert_eq!(status, Some(2), "{stderr}");
        assert!(stderr.contains("duration_s = "), "{stderr}");
    }
}

/// What cannot be written to stdout is no success; a reader that has gone away is no news.
#[cfg(target_os = "linux")]
#[test]
fn a_full_or_closed_stdout_is_an_error() {
    let folder = folder("stdout");
    let full = || std::fs::OpenOptions::new().write(true).open("/dev/full").expect("a full device");
    let run = ["run", "four-bar", "--duration", "0.1", "--json"];
    for arguments in [&["list"][..], &["list", "--json"], &run, &["--help"], &["run", "--help"]] {
        let output = program(&folder, arguments).stdout(full()).output().expect("it starts");
        let (status, _, stderr) = said(&output);
        assert_eq!(status, Some(1), "{arguments:?}: {stderr}");
        assert!(stderr.contains("standard output: No space"), "{arguments:?}: {stderr}");
        let (ours, theirs) = std::io::pipe().expect("a pipe");
        drop(ours);
        let output = program(&folder, arguments).stdout(theirs).output().expect("it starts");
        let (status, _, stderr) = said(&output);
        assert_eq!((status, stderr.as_str()), (Some(141), ""), "{arguments:?}");
    }
    // Nor does it break off where stderr is full.
    let bad = program(&folder, &["run", "no-such-scene"]).stderr(full()).output();
    assert_eq!(bad.expect("it starts").status.code(), Some(2));
}

/// Runs into one folder at the same time leave the files of one of them, whole.
#[test]
fn runs_at_once_leave_whole_files() {
    let folder = folder("at-once");
    let runs: Vec<_> = ["0.1", "0.2", "0.3", "0.4"]
        .map(|duration| {
            let all = ["run", "experiment-1", "--duration", duration, "--out", "one"];
            program(&folder, &all).stdout(Stdio::null()).spawn().expect("it starts")
        })
        .into_iter()
        .map(|mut run| run.wait().expect("it ends"))
        .collect();
    assert!(runs.iter().all(|status| status.success()), "{runs:?}");
    let one = folder.join("one");
    let mcap = std::fs::read(one.join("record.mcap")).expect("a record");
    assert!(mcap.starts_with(b"\x89MCAP0\r\n") && mcap.ends_with(b"\x89MCAP0\r\n"));
    let rows = rows(&one.join("record.csv"));
    assert!(rows.iter().all(|row| row.len() == rows[0].len()));
    assert!([51, 101, 151, 201].contains(&rows.len()));
    let names: Vec<_> = std::fs::read_dir(&one)
        .expect("a folder")
        .map(|entry| entry.expect("an entry").file_name().into_string().expect("UTF-8"))
        .collect();
    assert!(!names.iter().any(|name| name.ends_with(".part")), "{names:?}");
}

/// A run that goes on from a saved one does not take its record's place, nor does it run if there is nothing left.
#[test]
fn what_goes_on_keeps_what_was() {
    let folder = folder("resumed");
    let run = |more: &[&str]| {
        said(&surefoot(&folder, &[&["run", "box-drop", "--out", "box"], more].concat()))
    };
    assert_eq!(run(&["--duration", "0.3", "--save", "box.json"]).0, Some(0));
    let before = read_to_string(folder.join("box/record.csv")).expect("a record");
    for (more, words) in [
        (&["--duration", "0.3", "--resume", "box.json"][..], "it has reached 0.3 s"),
        (&["--duration", "0.5", "--resume", "box.json"], "--out must name another folder"),
        (&["--duration", "0.5", "--step", "5e-4", "--resume", "box.json"], "box/record.csv"),
    ] {
        let (status, _, stderr) = run(more);
        assert_eq!(status, Some(2), "{stderr}");
        assert!(stderr.contains(words), "{stderr}");
        assert_eq!(read_to_string(folder.join("box/record.csv")).expect("a record"), before);
    }
    let arguments = ["run", "box-drop", "--duration", "0.5", "--resume", "box.json", "--json"];
    let output = surefoot(&folder, &arguments);
    assert_eq!(output.status.code(), Some(0));
    let rows = rows(&folder.join("out/box-drop-from-0.3-s/record.csv"));
    assert_eq!((rows[0][0], rows[rows.len() - 1][0]), (0.3, 0.5));
}

/// A run is taken up under the controller that it was saved with: a supervisor remembers, and none does not.
#[test]
fn a_run_goes_on_under_its_controller() {
    let folder = folder("controller");
    let run = |controller: &str, more: &[&str]| {
        let all = [&["run", "experiment-1", "--controller", controller], more].concat();
        said(&surefoot(&folder, &all))
    };
    for (saver, other) in [("host", "bare"), ("bare", "host")] {
        assert_eq!(run(saver, &["--duration", "0.1", "--save", "run.json"]).0, Some(0));
        let (status, _, stderr) = run(other, &["--duration", "0.2", "--resume", "run.json"]);
        assert_eq!(status, Some(2), "{stderr}");
        assert!(stderr.contains("supervisor"), "{stderr}");
        let on = run(saver, &["--duration", "0.2", "--resume", "run.json"]);
        assert_eq!(on.0, Some(0), "{}", on.2);
    }
}

/// A saved run is taken up by the same motion under any name, and by no other.
#[test]
fn a_saved_run_is_known_by_its_motion() {
    let folder = folder("identity");
    let text = include_str!("../../scenes/box-drop.toml");
    let write = |name: &str, from: &str, to: &str| {
        assert!(text.contains(from), "{from}");
        std::fs::write(folder.join(name), text.replacen(from, to, 1)).expect("writable");
    };
    write("box.toml", "70 kg", "70 kg");
    let save = ["run", "box.toml", "--duration", "0.05", "--save", "box.json"];
    assert_eq!(surefoot(&folder, &save).status.code(), Some(0));
    let resume = |more: &[&str]| {
        let all = [&["run", "other.toml", "--duration", "0.06", "--resume", "box.json"], more];
        said(&surefoot(&folder, &all.concat()))
    };
    write("other.toml", "70 kg", "seventy kilograms");
    assert_eq!(resume(&[]).0, Some(0));
    for (from, to, words) in [
        ("mass_kg = 70.0", "mass_kg = 35.0", "mechanism.bodies[0].mass_kg = 70.0, not 35.0"),
        ("= 0.4\n", "= 0.5\n", "mechanism.floor.static_friction = 0.4, not 0.5"),
        ("step_s = 1e-3", "step_s = 2e-3", "integrator.step_s = 0.001, not 0.002"),
        ("velocity_m_s = [5.0,", "velocity_m_s = [6.0,", "joint.velocity_m_s[0] = 5.0, not 6.0"),
        ("switching = \"within-the-step\"", "switching = \"at-midpoint\"", "mechanism.switching"),
    ] {
        let text = text.replacen(from, to, 1);
        std::fs::write(folder.join("other.toml"), text).expect("writable");
        let (status, _, stderr) = resume(&[]);
        assert_eq!(status, Some(2), "{to}: {stderr}");
        assert!(stderr.contains(words), "{to}: {stderr}");
    }
    write("other.toml", "70 kg", "70 kg");
    let (status, _, stderr) = resume(&["--model", "full"]);
    assert_eq!(status, Some(2), "{stderr}");
    assert!(stderr.contains("model"), "{stderr}");
    // A robot's controller decides its motion, too.
    let robot = ["run", "experiment-1-welded", "--duration", "0.1"];
    let save = [&robot[..], &["--save", "robot.json", "--scalar", "f32"]].concat();
    assert_eq!(surefoot(&folder, &save).status.code(), Some(0));
    let other = ["run", "experiment-1-welded", "--duration", "0.2", "--resume", "robot.json"];
    let (status, _, stderr) = said(&surefoot(&folder, &other));
    assert_eq!(status, Some(2), "{stderr}");
    assert!(stderr.contains("--scalar f32, not f64"), "{stderr}");
}

/// A program that is asked to end keeps what there is, says so, and can go on from there.
#[cfg(target_os = "linux")]
#[test]
fn an_interrupted_run_keeps_what_there_is() {
    let folder = folder("interrupted");
    for (scene, signal) in [("four-bar", "INT"), ("experiment-1-welded", "TERM")] {
        let all =
            ["run", scene, "--duration", "1500", "--json", "--save", "there.json", "--out", scene];
        let mut run = program(&folder, &all)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("it starts");
        // Until it listens: bit 1 of the signals that it catches is SIGINT's.
        let status = format!("/proc/{}/status", run.id());
        let listens = || {
            let text = read_to_string(&status).expect("it runs");
            let caught =
                text.lines().find_map(|line| line.strip_prefix("SigCgt:")).expect("a mask");
            u64::from_str_radix(caught.trim(), 16).expect("a mask") & 2 != 0
        };
        while !listens() {
            assert!(run.try_wait().expect("its state").is_none(), "{scene} ended by itself");
            std::thread::sleep(std::time::Duration::from_millis(5));
        }
        std::thread::sleep(std::time::Duration::from_millis(200));
        let sent =
            Command::new("kill").args([&format!("-{signal}"), &run.id().to_string()]).status();
        assert!(sent.expect("kill").success());
        let output = run.wait_with_output().expect("it ends");
        let (status, _, stderr) = said(&output);
        assert_eq!(status, Some(130), "{stderr}");
        assert!(stderr.contains("interrupted at"), "{stderr}");
        let document = document(&output);
        assert_eq!(document["outcome"], "interrupted");
        let reached = document["duration_s"].as_f64().expect("a time");
        let rows = rows(&folder.join(scene).join("record.csv"));
        assert_eq!(rows.last().expect("rows")[0], reached);
        assert!(reached > 0.0 && reached < 1500.0, "{reached}");
        let later = format!("{}", reached + 0.1);
        let go_on = ["run", scene, "--duration", &later, "--resume", "there.json"];
        let (status, _, stderr) = said(&surefoot(&folder, &go_on));
        assert_eq!(status, Some(0), "{stderr}");
    }
}

/// A start in the floor is told with its depth and its energy; a plate whose numbers are rounded is told as such.
#[test]
fn what_is_off_at_the_start_is_told() {
    let folder = folder("warned");
    let text = include_str!("../../scenes/box-drop.toml");
    let with = |changes: [(&str, &str); 2]| {
        changes.iter().fold(text.to_owned(), |text, (from, to)| {
            assert!(text.contains(from), "{from}");
            text.replacen(from, to, 1)
        })
    };
    let upright = ("[0.9239, 0.2706, 0.2706, 0.0]", "[1.0, 0.0, 0.0, 0.0]");
    let warned = |text: &str| {
        std::fs::write(folder.join("box.toml"), text).expect("writable");
        let output = surefoot(&folder, &["run", "box.toml", "--duration", "0.05", "--json"]);
        let warnings = document(&output)["warnings"].as_array().expect("a list").clone();
        let (_, _, stderr) = said(&output);
        let told = warnings.iter().map(|w| w.as_str().expect("text").to_owned());
        told.inspect(|w| assert!(stderr.contains(w), "{stderr}")).collect::<Vec<_>>()
    };
    // Four corners 5 cm deep: 4 · ½ · 75 000 N/m · (0.05 m)² = 375 J.
    let deep =
        warned(&with([upright, ("center_m = [0.0, 0.0, 0.3]", "center_m = [0.0, 0.0, 0.05]")]));
    assert!(
        deep.len() == 1 && deep[0].contains("50.0 mm") && deep[0].contains("375.0 J"),
        "{deep:?}"
    );
    // At rest it is 70 · 9.81 / (4 · 75 000) = 2.289 mm deep, and nothing throws it up.
    let rest =
        warned(&with([upright, ("center_m = [0.0, 0.0, 0.3]", "center_m = [0.0, 0.0, 0.097711]")]));
    assert!(rest.is_empty(), "{rest:?}");
    let inertia = "[1.1666666666666667, 0.7583333333333333, 1.4583333333333333]";
    let plate = warned(&with([upright, (inertia, "[0.100, 0.700, 0.801]")]));
    assert!(plate.len() == 1 && plate[0].contains("bodies[0].inertia_kg_m2"), "{plate:?}");
    let robot = include_str!("../../scenes/experiment-1.toml");
    let sunk = robot.replacen("position_m = [0.0, 0.0, 1.035]", "position_m = [0.0, 0.0, 1.0]", 1);
    let sunk = warned(&sunk);
    assert!(sunk.len() == 1 && sunk[0].contains("the soles"), "{sunk:?}");
}

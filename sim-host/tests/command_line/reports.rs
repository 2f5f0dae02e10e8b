//! What every run leaves, whatever moves: a report with a replay, and a record with named columns; and scenes as files.

use crate::program::{folder, said, surefoot};
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs::read_to_string;
use std::path::Path;

/// Built-in scenes that have no joint, and those whose bodies touch a floor.
const WITHOUT_JOINTS: [&str; 2] = ["rigid-body", "box-drop"];
const ON_A_FLOOR: [&str; 13] = [
    "experiment-1",
    "experiment-1-pushes",
    "experiment-2",
    "stand",
    "stand-loaded",
    "walk",
    "walk-pushed",
    "run",
    "jump",
    "carry",
    "walk-estimated",
    "turn",
    "box-drop",
];

fn names(folder: &Path) -> Vec<String> {
    let (status, stdout, stderr) = said(&surefoot(folder, &["list", "--json"]));
    assert_eq!(status, Some(0), "{stderr}");
    let document: Value = serde_json::from_str(&stdout).expect("one document");
    let scenes = document["scenes"].as_array().expect("a list");
    scenes.iter().map(|scene| scene["name"].as_str().expect("a name").to_owned()).collect()
}

/// A record's head, and its rows as they stand.
fn table(record: &Path) -> (Vec<String>, Vec<Vec<String>>) {
    let text = read_to_string(record).expect("a record");
    let fields = |line: &str| line.split(',').map(str::to_owned).collect::<Vec<_>>();
    let mut lines = text.lines().map(fields);
    (lines.next().expect("a head"), lines.collect())
}

fn replay(page: &str) -> Value {
    let (_, rest) = page.split_once("id=\"replay-data\">").expect("a replay");
    let (data, _) = rest.split_once("</script>").expect("an end");
    serde_json::from_str(data).expect("JSON")
}

/// Each built-in scene, as it is and as the file that `show` prints: the same record to the last bit, with named columns,
/// and a page that plays it.
#[test]
fn every_scene_has_a_report_a_record_and_a_file() {
    let folder = folder("every-scene");
    let names = names(&folder);
    assert!(names.len() >= 14, "{names:?}");
    for name in &names {
        let run = |scene: &str, out: &str| {
            let all = ["run", scene, "--duration", "0.05", "--out", out, "--json"];
            let (status, stdout, stderr) = said(&surefoot(&folder, &all));
            assert_eq!(status, Some(0), "{scene}: {stderr}");
            let document: Value = serde_json::from_str(&stdout).expect("one document");
            document
        };
        let document = run(name, name);
        let files: BTreeSet<&str> = document["files"]
            .as_array()
            .expect("a list")
            .iter()
            .map(|file| file.as_str().expect("a path"))
            .collect();
        for file in ["report.html", "record.csv", "record.mcap"] {
            assert!(files.contains(&*format!("{name}/{file}")), "{name}: {files:?}");
        }

        let (head, rows) = table(&folder.join(name).join("record.csv"));
        assert_eq!(head.iter().collect::<BTreeSet<_>>().len(), head.len(), "{name}: {head:?}");
        assert!(rows.len() > 1 && rows.iter().all(|row| row.len() == head.len()), "{name}");
        let has = |ending: &str| head.iter().any(|column| column.ends_with(ending));
        let has_joints = !WITHOUT_JOINTS.contains(&&**name);
        assert_eq!(has("_rad"), has_joints, "{name}: {head:?}");
        let angle = head.iter().position(|column| column.ends_with("_rad"));
        for row in &rows {
            assert!(angle.is_none_or(|k| row[k].parse::<f64>().is_ok()), "{name}: {row:?}");
        }
        if ON_A_FLOOR.contains(&&**name) {
            assert!(has("_f_z_n") && has("_state"), "{name}: {head:?}");
        }

        let page = read_to_string(folder.join(name).join("report.html")).expect("a page");
        assert!(page.starts_with("<!DOCTYPE html>") && page.trim_end().ends_with("</html>"));
        assert!(page.matches("<svg").count() >= 3, "{name}");
        let data = replay(&page);
        let length = |what: &str| data[what].as_array().expect("a list").len();
        let bodies = data["bodies"].as_u64().expect("a number") as usize;
        assert_eq!(length("poses"), 7 * bodies * length("times"), "{name}");
        let of_body = |solid: &&Value| solid["body"].is_u64();
        let solids = data["solids"].as_array().expect("a list");
        assert!(solids.iter().filter(of_body).count() >= bodies, "{name}");

        let (status, text, stderr) = said(&surefoot(&folder, &["show", name]));
        assert_eq!(status, Some(0), "{stderr}");
        let file = format!("{name}.toml");
        std::fs::write(folder.join(&file), text).expect("writable");
        run(&file, &format!("{name}-of-file"));
        for record in ["record.csv", "record.mcap"] {
            let bytes = |of: &str| std::fs::read(folder.join(of).join(record)).expect("a record");
            assert!(bytes(name) == bytes(&format!("{name}-of-file")), "{name}: {record}");
        }
    }
}

#[test]
fn what_is_no_built_in_scene_is_not_shown() {
    let folder = folder("show");
    for (name, words) in [
        ("box-dorp", vec!["'box-dorp'", "did you mean 'box-drop'?", "four-bar", "experiment-1"]),
        ("something-else-entirely", vec!["'something-else-entirely'", "four-bar"]),
    ] {
        let (status, stdout, stderr) = said(&surefoot(&folder, &["show", name]));
        assert_eq!((status, &*stdout), (Some(2), ""));
        for word in words {
            assert!(stderr.contains(word), "{stderr}, without {word}");
        }
    }
    let (status, stdout, _) = said(&surefoot(&folder, &["show", "chain", "--json"]));
    assert_eq!(status, Some(0));
    let document: Value = serde_json::from_str(&stdout).expect("one document");
    assert_eq!((&document["scene"], &document["kind"]), (&"chain".into(), &"mechanism".into()));
    assert!(document["toml"].as_str().is_some_and(|text| text.contains("kind = \"chain\"")));
}

/// At rest the floor bears the box's weight, 70 kg, under every model alike.
#[test]
fn the_floor_s_forces_are_the_weight_in_the_end() {
    let folder = folder("weight");
    for model in ["single-body", "full"] {
        let all = ["run", "box-drop", "--duration", "3", "--model", model, "--out", model];
        let (status, _, stderr) = said(&surefoot(&folder, &all));
        assert_eq!(status, Some(0), "{stderr}");
        let (head, rows) = table(&folder.join(model).join("record.csv"));
        let last = rows.last().expect("rows");
        let vertical = head.iter().zip(last).filter(|(column, _)| column.ends_with("_f_z_n"));
        let sum: f64 = vertical.map(|(_, force)| force.parse::<f64>().expect("a number")).sum();
        // Off by at most 1.5e-11 N.
        assert!((sum - 70.0 * 9.81).abs() < 1e-10, "{model}: {sum} N");
    }
}

/// Motors, springs, and what joints bear, of a tree that a user describes; a report also of one that fails.
#[test]
fn a_tree_of_ones_own_has_torques_and_reactions() {
    let folder = folder("own-tree");
    let text = "
description = \"two <b>arms</b>\"
duration_s = 0.2
[integrator]
name = \"variational\"
step_s = 1e-3
[mechanism]
kind = \"multibody\"
gravity_m_s2 = 9.81
[[mechanism.bodies]]
name = \"Upper arm\"
mass_kg = 2.0
inertia_kg_m2 = [0.06, 0.06, 0.002]
center_m = [0.0, 0.0, -0.3]
joint = { kind = \"revolute\", point_m = [0.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0] }
torque = 1.5
[[mechanism.bodies]]
name = \"slider\"
inboard = \"Upper arm\"
mass_kg = 1.0
inertia_kg_m2 = [0.03, 0.03, 0.001]
center_m = [0.0, 0.0, -0.8]
joint = { kind = \"prismatic\", axis = [0.0, 0.0, 1.0] }
law = { stiffness = 200.0, damping = 3.0 }
";
    std::fs::write(folder.join("arms.toml"), text).expect("writable");
    let (status, _, stderr) = said(&surefoot(&folder, &["run", "arms.toml"]));
    assert_eq!(status, Some(0), "{stderr}");
    let (head, rows) = table(&folder.join("out/arms/record.csv"));
    let number = |row: usize, column: &str| -> f64 {
        let k = head.iter().position(|name| name == column);
        let k = k.unwrap_or_else(|| panic!("no {column} in {head:?}"));
        rows[row][k].parse().unwrap_or(f64::NAN)
    };
    assert_eq!(number(7, "upper_arm_joint_nm"), 1.5);
    for row in [50, 150] {
        let (x, rate) = (number(row, "slider_joint_m"), number(row, "slider_joint_mps"));
        let force = number(row, "slider_joint_n");
        assert!((force + 200.0 * x + 3.0 * rate).abs() < 1e-12, "{force} N at {x} m");
        assert!(x < 0.0, "the spring gives way to the weight");
        assert!(number(row, "upper_arm_joint_rad").abs() > 1e-4);
        // The motor's torque is what the joint bears about its axis: to 6e-14 N·m.
        assert!((number(row, "upper_arm_joint_t_y_nm") - 1.5).abs() < 1e-12);
        assert!(number(row, "upper_arm_joint_f_z_n") > 10.0);
    }
    // Nothing is known before the first step.
    assert!(number(0, "upper_arm_joint_f_z_n").is_nan());
    let page = read_to_string(folder.join("out/arms/report.html")).expect("a page");
    assert!(!page.contains("<b>arms") && page.contains("What is kept"));

    let too_long = ["run", "rigid-body", "--integrator", "variational", "--step", "0.3"];
    let (status, _, _) = said(&surefoot(&folder, &[&too_long[..], &["--out", "failed"]].concat()));
    assert_eq!(status, Some(1));
    let page = read_to_string(folder.join("failed/report.html")).expect("a page");
    assert!(page.contains("Advice:") && page.contains("class=\"outcome failed\""));
    assert!(!replay(&page)["times"].as_array().expect("a list").is_empty());
}

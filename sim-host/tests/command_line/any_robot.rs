//! A robot of no text: imported, and stood on its legs, by two commands.

use crate::program::{folder, said, surefoot};
use serde_json::Value;

const HERON: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/heron.urdf");

/// A column of the record's last row.
fn last(header: &str, row: &str, name: &str) -> f64 {
    let column = header.split(',').position(|column| column == name);
    let column = column.unwrap_or_else(|| panic!("no column {name}"));
    row.split(',').nth(column).expect("as many fields").parse().expect("a number")
}

#[test]
fn a_urdf_stands_after_two_commands() {
    let folder = folder("any-robot");
    let (status, stdout, stderr) = said(&surefoot(&folder, &["import", HERON, "--out", "heron"]));
    assert_eq!(status, Some(0), "{stderr}");
    for word in ["feet found: port_sole, starboard_sole", "stand.toml"] {
        assert!(stdout.contains(word), "{word}: {stdout}");
    }
    let scene = std::fs::read_to_string(folder.join("heron/stand.toml")).expect("written");
    // Its tail moves.
    assert!(scene.contains("wag = 0.0"), "{scene}");

    let run = ["run", "heron/stand.toml", "--scalar", "f32", "--json", "--out", "stood"];
    let (status, stdout, stderr) = said(&surefoot(&folder, &run));
    assert_eq!(status, Some(0), "{stderr}{stdout}");
    let document: Value = serde_json::from_str(&stdout).expect("one document");
    assert_eq!(document["outcome"], "balanced", "{stdout}");
    let record = std::fs::read_to_string(folder.join("stood/record.csv")).expect("written");
    let (header, row) = (record.lines().next().expect("a header"), record.lines().last());
    let row = row.expect("a row");
    assert!(last(header, row, "time_s") >= 2.0);
    // It stands on bent legs, on both feet: 30.4 kg with its tail.
    assert!(last(header, row, "port_bend_rad") > 0.3);
    let on_feet = last(header, row, "port_sole_n") + last(header, row, "starboard_sole_n");
    let weight = 9.81 * (14.0 + 0.6 + 2.0 * (0.8 + 0.9 + 3.0 + 2.0 + 0.3 + 0.9));
    assert!((on_feet / weight - 1.0).abs() < 1e-2, "{on_feet} N of {weight} N");
    for name in ["port_yaw_nm", "starboard_roll_radps", "starboard_sole_point_4_f_z_n"] {
        last(header, row, name);
    }
    let report = std::fs::read_to_string(folder.join("stood/report.html")).expect("written");
    assert!(report.contains("starboard_swing"), "the report has the robot's joints");
}

/// Errors name the file, the line and the field.
#[test]
fn wrong_robots_are_refused_with_their_place() {
    let folder = folder("any-robot-wrong");
    said(&surefoot(&folder, &["import", HERON, "--out", "heron"]));
    let scene = std::fs::read_to_string(folder.join("heron/stand.toml")).expect("written");
    for (from, to, words) in [
        ("file = \"robot.toml\"", "file = \"rabbit.toml\"", ["robot.file", "rabbit.toml"]),
        (
            "file = \"robot.toml\"",
            "file = \"robot.toml\"\nlock = { wig = 0.0 }",
            ["robot.file", "is wag meant?"],
        ),
        ("port_bend =", "port_band =", ["initial.joints_deg.port_band", "port_bend"]),
        ("[feet]\n", "[feet]\noutline = \"A\"\n", ["feet.outline", "from a file"]),
        ("name = \"variational\"", "name = \"rk4\"", ["integrator.name", "rk4"]),
    ] {
        assert!(scene.contains(from), "{from}: {scene}");
        let path = folder.join("heron/wrong.toml");
        std::fs::write(path, scene.replacen(from, to, 1)).expect("written");
        let (status, _, stderr) = said(&surefoot(&folder, &["run", "heron/wrong.toml"]));
        assert_eq!(status, Some(2), "{to}: {stderr}");
        for word in words.into_iter().chain(["heron/wrong.toml:"]) {
            assert!(stderr.contains(word), "{to}: {word}: {stderr}");
        }
    }
}

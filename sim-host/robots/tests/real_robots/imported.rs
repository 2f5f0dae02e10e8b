//! Every URDF of example-robot-data: what has come of it stands in docs/robots.md.

use crate::{example_robot, root};
use std::path::{Path, PathBuf};
use surefoot_robots::{ImportError, Options, Robot, import, legs, robot_rs, robot_toml};

const BEGIN: &str = "<!-- Begin of what the test writes. -->\n";
const END: &str = "<!-- End of what the test writes. -->";

fn all() -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut open = vec![example_robot("")];
    while let Some(folder) = open.pop() {
        for entry in std::fs::read_dir(folder).expect("the package's folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|ending| ending == "urdf") {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

/// Reads, makes the tree, and reads back what was written.
fn through(path: &Path) -> Result<Robot, ImportError> {
    let robot = import(path, &Options::default())?.robot;
    robot_rs(&robot)?;
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join("through.toml");
    std::fs::write(&file, robot_toml(&robot)).expect("written");
    let back = import(&file, &Options::default())?.robot;
    assert!(back == robot, "{} comes back otherwise", path.display());
    Ok(robot)
}

fn row(path: &Path) -> String {
    let name = path.strip_prefix(example_robot("")).expect("in the package").display().to_string();
    match through(path) {
        Ok(robot) => format!(
            "| {name} | {} links, {} degrees of freedom, {:.2} kg |\n",
            robot.links.len(),
            robot.degrees_of_freedom(),
            robot.mass()
        ),
        Err(error) => {
            let folder = format!("{}/", path.parent().expect("a folder").display());
            format!("| {name} | refused: {} |\n", error.to_string().replace(&folder, ""))
        }
    }
}

/// `SUREFOOT_BLESS=1` writes the table anew.
#[test]
#[ignore = "needs robot files: `cargo xtask test --only robots`"]
fn every_urdf_is_imported_or_refused_as_documented() {
    let files = all();
    assert_eq!(files.len(), 69, "all of the package's files");
    let table: String = files.iter().map(|path| row(path)).collect();
    let table = format!("\n| file | result |\n|---|---|\n{table}\n");
    let document = root().join("docs/robots.md");
    let text = std::fs::read_to_string(&document).expect("the document");
    let (before, rest) = text.split_once(BEGIN).expect("where the table begins");
    let (found, after) = rest.split_once(END).expect("where it ends");
    if std::env::var_os("SUREFOOT_BLESS").is_some() {
        std::fs::write(&document, format!("{before}{BEGIN}{table}{END}{after}")).expect("written");
    } else {
        assert!(found == table, "docs/robots.md has another table than\n{table}");
    }
}

/// Feet of robots that stand: how many points each has, and how far the outermost are apart.
#[test]
#[ignore = "needs robot files: `cargo xtask test --only robots`"]
fn feet_have_the_soles_of_their_shapes() {
    for (urdf, feet, points, length, legs_found) in [
        // Four spheres.
        (
            "g1_description/urdf/g1_29dof_rev_1_0.urdf",
            ["left_ankle_roll_link", "right_ankle_roll_link"],
            4,
            0.17,
            2,
        ),
        // A mesh in STL.
        (
            "talos_data/robots/talos_reduced.urdf",
            ["leg_left_6_link", "leg_right_6_link"],
            4,
            0.2,
            2,
        ),
        // A box.
        (
            "talos_data/robots/talos_reduced_box.urdf",
            ["leg_left_6_link", "leg_right_6_link"],
            4,
            0.2,
            2,
        ),
    ] {
        let options = Options {
            feet: feet.map(str::to_owned).to_vec(),
            legs_only: true,
            ..Options::default()
        };
        let robot = import(&example_robot(urdf), &options).unwrap_or_else(|e| panic!("{e}")).robot;
        assert_eq!(legs(&robot), Some(legs_found), "{urdf}");
        for foot in &robot.feet {
            assert_eq!(foot.points.len(), points, "{urdf}: {foot:?}");
            let x = |worse: fn(f64, f64) -> f64, start| {
                foot.points.iter().map(|p| p.x).fold(start, worse)
            };
            let found = x(f64::max, f64::MIN) - x(f64::min, f64::MAX);
            assert!((found - length).abs() < 0.01, "{urdf}: {found} m is not {length} m");
        }
    }
}

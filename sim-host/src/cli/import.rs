//! `surefoot import`: a URDF or MJCF file to a robot of names, and to const data for firmware.

use super::{BAD_INPUT, RUN_FAILED, complain, say};
use clap::{Args, ValueEnum};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use surefoot_robots::{
    BaseChoice, ImportError, Imported, Options as ImportOptions, Robot, Sole, import, legs,
    robot_rs, robot_toml,
};
use surefoot_sim::closed_loop::firmware::robot_module;
use surefoot_sim::robot::{Robot as SceneRobot, stand_scene};
use surefoot_sim::scene::load;
use surefoot_sim::written::write_text;

/// Of what file, how, and where to.
#[derive(Debug, Args)]
pub(super) struct Options {
    /// A URDF (.urdf) or MJCF (.xml) file, or a robot.toml
    robot: PathBuf,
    #[command(flatten)]
    how: How,
    /// Links that stand on the floor
    #[arg(long, value_name = "LINK", value_delimiter = ',')]
    feet: Vec<String>,
    /// A foot's sole, a rectangle in the link's frame in m: LINK=X_MIN,X_MAX,Y_MIN,Y_MAX,Z (may be given several times)
    #[arg(long = "sole", value_name = "SOLE", value_parser = sole, allow_hyphen_values = true)]
    soles: Vec<Sole>,
    /// Lock every joint that no foot hangs from, at 0 or where --lock says
    #[arg(long)]
    legs_only: bool,
    /// Take joints that follow others as free ones, and leave out constraints between bodies
    #[arg(long)]
    free_couplings: bool,
    /// Folder for robot.toml and robot.rs (default: named after the file, here)
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print one JSON document on stdout, and nothing else
    #[arg(long)]
    json: bool,
}

/// What `import` and `dynamics` have in common.
#[derive(Debug, Args)]
pub(super) struct How {
    /// Joints to fix, in rad or m (default 0)
    #[arg(long = "lock", value_name = "JOINT[=ANGLE]", value_delimiter = ',', value_parser = lock)]
    locks: Vec<(String, f64)>,
    /// What carries the root link (default: the file's; of a URDF, nothing unless it is named `world`)
    #[arg(long, value_enum, default_value_t = BaseName::Auto)]
    base: BaseName,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum BaseName {
    Auto,
    Fixed,
    Floating,
}

impl How {
    /// The reader's options; feet and the like are the importer's.
    pub fn options(&self) -> ImportOptions {
        ImportOptions {
            base: match self.base {
                BaseName::Auto => BaseChoice::Auto,
                BaseName::Fixed => BaseChoice::Fixed,
                BaseName::Floating => BaseChoice::Floating,
            },
            locks: self.locks.clone(),
            ..ImportOptions::default()
        }
    }
}

fn lock(text: &str) -> Result<(String, f64), String> {
    let Some((joint, angle)) = text.split_once('=') else { return Ok((text.to_owned(), 0.0)) };
    match angle.trim().parse::<f64>() {
        Ok(angle) if angle.is_finite() => Ok((joint.to_owned(), angle)),
        _ => Err(format!("expected JOINT=ANGLE with a finite angle, found {angle:?}")),
    }
}

fn sole(text: &str) -> Result<Sole, String> {
    let expected = "expected LINK=X_MIN,X_MAX,Y_MIN,Y_MAX,Z in m";
    let (link, numbers) = text.split_once('=').ok_or(expected)?;
    let numbers: Option<Vec<f64>> =
        numbers.split(',').map(|x| x.trim().parse().ok().filter(|x: &f64| x.is_finite())).collect();
    let rectangle: [f64; 5] =
        numbers.and_then(|numbers| numbers.try_into().ok()).ok_or(expected)?;
    let [x_min, x_max, y_min, y_max, _] = rectangle;
    if !(x_min < x_max && y_min < y_max) {
        return Err(format!("{expected}, each from low to high"));
    }
    Ok(Sole { link: link.to_owned(), rectangle })
}

/// Imports, writes, says what has come of it.
pub(super) fn run(options: &Options) -> ExitCode {
    let how = ImportOptions {
        feet: options.feet.clone(),
        soles: options.soles.clone(),
        legs_only: options.legs_only,
        free_couplings: options.free_couplings,
        find_feet: true,
        ..options.how.options()
    };
    let source = import(&options.robot, &how)
        .and_then(|imported| Ok((robot_rs(&imported.robot)?, imported)));
    let (source, imported) = match source {
        Ok(both) => both,
        Err(error) => return refused(&error, options.json),
    };
    let folder = options
        .out
        .clone()
        .unwrap_or_else(|| PathBuf::from(options.robot.file_stem().unwrap_or("robot".as_ref())));
    let standing = standing(&imported.robot);
    let written = write_all(&folder, &robot_toml(&imported.robot), source, standing.as_ref().ok());
    let paths = match written {
        Ok(paths) => paths,
        Err(error) => return failed("file", &error, options.json),
    };
    let said = match options.json {
        true => format!("{:#}\n", document(&imported, &paths)),
        false => summary(&imported, &paths, standing.as_ref().err()),
    };
    say(&said, ExitCode::SUCCESS)
}

/// A scene in which the robot stands on its legs; or why no such scene exists.
fn standing(robot: &Robot) -> Result<String, String> {
    if robot.feet.is_empty() {
        return Err("it has no feet that are found (--feet names them)".into());
    }
    let robot = SceneRobot::of_file(robot)
        .map_err(|error| format!("the balance controller takes {error}"))?;
    stand_scene(&robot, "robot.toml").ok_or_else(|| "its legs find no angles to stand on".into())
}

/// Writes the files, and says which. What firmware takes is read from the others, as a run reads them.
fn write_all(
    folder: &Path,
    robot: &str,
    mut source: String,
    standing: Option<&String>,
) -> Result<Vec<String>, String> {
    std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut paths = Vec::new();
    let mut write = |name: &str, text: &str| {
        let path = folder.join(name);
        paths.push(path.display().to_string());
        write_text(&path, text)
    };
    write("robot.toml", robot)?;
    if let Some(standing) = standing {
        write("stand.toml", standing)?;
        let scene = load(&folder.join("stand.toml").display().to_string());
        let scene = scene.map_err(|error| format!("what was written cannot be read: {error}"))?;
        source += &robot_module(&scene).unwrap_or_default();
    }
    write("robot.rs", &source)?;
    Ok(paths)
}

/// A robot file that is refused: exit status 2.
pub(super) fn refused(error: &ImportError, json: bool) -> ExitCode {
    complain(format_args!("error: {error}"));
    let status = ExitCode::from(BAD_INPUT);
    if json {
        let place = error.place();
        let document = json!({ "error": {
            "kind": error.kind(),
            "message": error.to_string(),
            "file": place.map(|place| place.file.as_ref()),
            "line": place.map(|place| place.line),
        } });
        return say(&format!("{document:#}\n"), status);
    }
    status
}

/// What went wrong with good input: exit status 1.
pub(super) fn failed(kind: &str, message: &str, json: bool) -> ExitCode {
    complain(format_args!("error: {message}"));
    let status = ExitCode::from(RUN_FAILED);
    if json {
        let document = json!({ "error": { "kind": kind, "message": message } });
        return say(&format!("{document:#}\n"), status);
    }
    status
}

fn document(imported: &Imported, paths: &[String]) -> Value {
    let Imported { robot, notes, locked, unread } = imported;
    let joints = robot.links.iter().map(|link| {
        json!({ "name": link.joint.name, "link": link.name, "kind": kind(robot, &link.name) })
    });
    json!({
        "robot": robot.name,
        "links": robot.links.len(),
        "degrees_of_freedom": robot.degrees_of_freedom(),
        "mass_kg": robot.mass(),
        "joints": joints.collect::<Vec<_>>(),
        "frames": robot.frames.iter().map(|frame| &frame.name).collect::<Vec<_>>(),
        "locked": locked.iter().map(|(name, at)| json!({ "joint": name, "at": at })).collect::<Vec<_>>(),
        "feet": robot.feet.iter().map(|foot| {
            let points: Vec<[f64; 3]> = foot.points.iter().map(|p| (*p).into()).collect();
            json!({ "name": foot.name, "link": robot.links[foot.link].name, "points_m": points })
        }).collect::<Vec<_>>(),
        "legs": legs(robot),
        "notes": notes,
        "not_read": unread,
        "files": paths,
    })
}

fn kind(robot: &Robot, link: &str) -> String {
    let found = robot.links.iter().find(|other| other.name == link);
    found.map(|link| format!("{:?}", link.joint.motion).to_lowercase()).unwrap_or_default()
}

fn summary(imported: &Imported, paths: &[String], no_scene: Option<&String>) -> String {
    use std::fmt::Write;
    let Imported { robot, notes, locked, unread } = imported;
    let mut out = format!(
        "{}: {} moving links, {} degrees of freedom, {:.3} kg, {} named frames\n",
        robot.name,
        robot.links.len(),
        robot.degrees_of_freedom(),
        robot.mass(),
        robot.frames.len()
    );
    let mut line = |text: String| {
        // Writing to a string does not fail.
        let _ = writeln!(out, "  {text}");
    };
    for foot in &robot.feet {
        line(format!("foot {}: {} points on the floor", foot.name, foot.points.len()));
    }
    match legs(robot) {
        Some(legs) => line(format!("the balance controller takes it: {legs} legs of 6 joints")),
        None => line("no LEGGED for the recursive controller, which takes a floating body on legs of 6 revolute joints and nothing else (see --legs-only)".into()),
    }
    if !locked.is_empty() {
        let names: Vec<String> = locked.iter().map(|(name, at)| format!("{name}={at}")).collect();
        line(format!("locked: {}", names.join(", ")));
    }
    notes.iter().for_each(|note| line(format!("note: {note}")));
    if !unread.is_empty() {
        let all: Vec<String> = unread.iter().map(|(tag, n)| format!("{tag} ×{n}")).collect();
        line(format!("not read: {}", all.join(", ")));
    }
    match no_scene {
        Some(reason) => line(format!("no stand.toml: {reason}")),
        None => line("stand.toml stands on its legs".into()),
    }
    line(format!("wrote {}", paths.join(" and ")));
    out
}

//! `robot.rs`: a robot as constant data for firmware, in flash.

use crate::dynamics::{Dynamics, Precision};
use crate::error::{ImportError, Refusal};
use crate::robot::{Robot, RobotLink, RobotMotion};
use crate::tree::{components, home_links};
use std::fmt::Write;

/// Joints of a leg that the controller takes.
const LEG: usize = 6;

/// The text of a robot's module: `TREE` and `TREE_F32`, names, limits and feet, and `LEGGED` where the
/// controller takes the robot. It needs `surefoot` and nothing else.
///
/// # Errors
/// A joint follows another, as a tree has independent joints; or core refuses a link.
pub fn robot_rs(robot: &Robot) -> Result<String, ImportError> {
    for link in &robot.links {
        if let Some(coupling) = link.joint.follows {
            let refusal = Refusal::Coupled {
                joint: link.joint.name.clone(),
                leader: robot.links[coupling.leader].joint.name.clone(),
            };
            let subject = format!("joint {}", link.joint.name);
            return Err(ImportError::refused(None, subject, refusal));
        }
    }
    // What core refuses here would not compile there.
    Dynamics::new(robot, Precision::F64)?;
    let mut out = String::new();
    // Writing to a string does not fail.
    let _ = write(robot, &mut out);
    Ok(out)
}

/// How many legs of six revolute joints the robot has on its floating first link, if it has nothing else.
pub fn legs(robot: &Robot) -> Option<usize> {
    let (central, rest) = robot.links.split_first()?;
    let is_leg = |(leg, links): (usize, &[RobotLink])| {
        let first = 1 + leg * LEG;
        links.iter().enumerate().all(|(i, link)| {
            let inboard = if i == 0 { 0 } else { first + i - 1 };
            let turns =
                matches!(link.joint.motion, RobotMotion::Revolute | RobotMotion::Continuous);
            turns && link.parent == Some(inboard)
        }) && reaches(links)
    };
    let legged = central.joint.motion == RobotMotion::Floating
        && !rest.is_empty()
        && rest.len() % LEG == 0
        && rest.chunks(LEG).enumerate().all(is_leg);
    legged.then_some(rest.len() / LEG)
}

/// Whether a leg's joints are apart: one whose joints all lie in one point cannot stand.
fn reaches(leg: &[RobotLink]) -> bool {
    leg.iter().skip(1).any(|link| link.joint.origin.translation.vector.norm() > 1e-6)
}

/// A robot's tree as an expression of Rust, of the type that its place gives it.
pub fn tree_source(robot: &Robot) -> String {
    let mut out = "Tree::new([\n".to_owned();
    // Writing to a string does not fail.
    let mut line = |text: String| out.write_str(&text).unwrap_or_default();
    for (k, (link, home)) in robot.links.iter().zip(home_links(robot)).enumerate() {
        line(format!("    // {k}: {} on {}\n", one_line(&link.name), one_line(&link.joint.name)));
        line(format!("    {},\n", home.to_source()));
    }
    line(format!("])\n.with_gravity({:?})", robot.gravity));
    out
}

fn write(robot: &Robot, out: &mut String) -> std::fmt::Result {
    let n = robot.links.len();
    let velocities = robot.degrees_of_freedom();
    let quaternions = robot.links.iter().filter(|l| !l.joint.motion.has_axis()).count();
    let legs = legs(robot);
    writeln!(out, "//! {}: {n} links, {:.3} kg.", one_line(&robot.name), robot.mass())?;
    writeln!(
        out,
        "//!\n//! Written by `surefoot import`; edit `robot.toml` and import that instead.\n"
    )?;
    if legs.is_some() {
        writeln!(out, "use surefoot::balance::LeggedRobot;")?;
    }
    writeln!(out, "use surefoot::model::{{Link, Tree}};\n")?;
    writeln!(out, "/// The tree in precision `T`.")?;
    writeln!(
        out,
        "pub type Robot<T> = Tree<T, {n}, {}, {velocities}>;\n",
        velocities + quaternions
    )?;
    writeln!(out, "/// In double precision.\n#[rustfmt::skip]")?;
    writeln!(out, "pub const TREE: Robot<f64> = {};\n", tree_source(robot))?;
    writeln!(out, "/// In single precision, for the target.")?;
    writeln!(out, "pub const TREE_F32: Robot<f32> = TREE.to_f32();\n")?;
    if let Some(legs) = legs {
        writeln!(out, "/// As the balance controller takes it.")?;
        writeln!(out, "pub const LEGGED: LeggedRobot<f64, {legs}> = LeggedRobot::new(&TREE);\n")?;
        writeln!(out, "/// The same in single precision.")?;
        writeln!(out, "pub const LEGGED_F32: LeggedRobot<f32, {legs}> = LEGGED.to_f32();\n")?;
    }
    names(robot, out)?;
    limits(robot, out)?;
    feet(robot, out)
}

fn names(robot: &Robot, out: &mut String) -> std::fmt::Result {
    let n = robot.links.len();
    for (what, constant) in [("Links", "LINK_NAMES"), ("Joints", "JOINT_NAMES")] {
        writeln!(out, "/// {what}, by index.\n#[rustfmt::skip]")?;
        writeln!(out, "pub const {constant}: [&str; {n}] = [")?;
        for link in &robot.links {
            let name = if constant == "LINK_NAMES" { &link.name } else { &link.joint.name };
            writeln!(out, "    {name:?},")?;
        }
        writeln!(out, "];\n")?;
    }
    Ok(())
}

fn limits(robot: &Robot, out: &mut String) -> std::fmt::Result {
    let n = robot.links.len();
    writeln!(out, "/// End stops by joints, rad or m.\n#[rustfmt::skip]")?;
    writeln!(out, "pub const RANGES: [Option<[f64; 2]>; {n}] = [")?;
    for link in &robot.links {
        writeln!(out, "    {:?},", link.joint.properties.range)?;
    }
    writeln!(out, "];\n")?;
    for (what, constant) in [("rates, rad/s or m/s", "RATES"), ("efforts, N m or N", "EFFORTS")] {
        writeln!(out, "/// Greatest {what}, by joints.\n#[rustfmt::skip]")?;
        writeln!(out, "pub const {constant}: [Option<f64>; {n}] = [")?;
        for link in &robot.links {
            let properties = &link.joint.properties;
            let limit = if constant == "RATES" { properties.rate } else { properties.effort };
            writeln!(out, "    {limit:?},")?;
        }
        writeln!(out, "];\n")?;
    }
    Ok(())
}

fn feet(robot: &Robot, out: &mut String) -> std::fmt::Result {
    let n = robot.feet.len();
    let links: Vec<usize> = robot.feet.iter().map(|foot| foot.link).collect();
    writeln!(out, "/// Links that stand on the floor.")?;
    writeln!(out, "pub const FEET: [usize; {n}] = {links:?};\n")?;
    writeln!(
        out,
        "/// Where each foot touches the floor, in its link's axes from the centre of mass, m."
    )?;
    writeln!(out, "#[rustfmt::skip]\npub const SOLE_POINTS: [&[[f64; 3]]; {n}] = [")?;
    for foot in &robot.feet {
        let center = robot.links[foot.link].inertial.center;
        let points: Vec<[f64; 3]> = foot.points.iter().map(|p| components(&(p - center))).collect();
        writeln!(out, "    &{points:?},")?;
    }
    writeln!(out, "];")
}

/// A name that cannot end a comment.
fn one_line(name: &str) -> String {
    name.escape_debug().collect()
}

//! A robot as the firmware takes it: the last module of its `robot.rs`.
//!
//! Limits, soles and gains are derived here from the robot's file and scene, and nowhere else: the firmware finds them
//! as constants.

use super::{folder_name, gains, set_point};
use crate::robot::{Robot, with_tree};
use crate::scene::Scene;
use std::fmt::Write;
use surefoot_robots::tree_source;

/// The module's text, of the robot that a scene reads from a file, with the scene's gains and set point; `None` for a
/// scene of another robot, and for one that no firmware balances yet.
pub fn robot_module(scene: &Scene) -> Option<String> {
    let fingerprint = scene.robot().id()?.fingerprint;
    let tree = tree_source(scene.robot.as_ref()?.described()?);
    let mut out = String::new();
    // Writing to a string does not fail.
    write(&mut out, scene, &tree, fingerprint).ok()?;
    Some(out)
}

fn write(out: &mut String, scene: &Scene, tree: &str, fingerprint: u32) -> std::fmt::Result {
    let robot = scene.robot();
    let (legs, joints, pose) = (robot.leg_count(), robot.joint_count(), set_point(scene));
    let size = format!("{}, {}, {}", joints + 1, joints + 7, joints + 6);
    writeln!(out, "\n/// What the firmware balances: joints that no foot hangs from are locked.")?;
    writeln!(out, "#[rustfmt::skip]\npub mod firmware {{")?;
    writeln!(
        out,
        "use surefoot::balance::{{JointDamping, JointLimits, LeggedRobot, SafetyLimits, Sole, Thresholds}};\n\
         use surefoot::model::{{Link, Tree}};\n"
    )?;
    writeln!(out, "/// Its images are in the folder `target/firmware` below this name.")?;
    writeln!(out, "pub const NAME: &str = {:?};", folder_name(&robot))?;
    writeln!(out, "/// Of `ROBOT` and `LIMITS`, by which the other end of the link knows them.")?;
    writeln!(out, "pub const FINGERPRINT: u32 = {fingerprint:#010x};")?;
    writeln!(out, "/// Legs of six revolute joints.\npub const LEGS: usize = {legs};\n")?;
    writeln!(out, "/// Of the legs' joints.\npub const TREE: Tree<f64, {size}> = {tree};\n")?;
    writeln!(out, "/// As the balance controller takes it.")?;
    let sized = "LeggedRobot::<f64, LEGS>::new(&TREE).to_f32()";
    writeln!(out, "pub const ROBOT: LeggedRobot<f32, LEGS> = {sized};\n")?;
    writeln!(out, "/// What its supervisor allows: messages may be tighter, and no wider.")?;
    let limits = limits(&robot);
    writeln!(out, "pub const LIMITS: SafetyLimits<f32, LEGS> = {limits}.to_f32();\n")?;
    writeln!(
        out,
        "/// Its soles, if they are rectangles: origin at the last joint, axes as the robot"
    )?;
    writeln!(out, "/// is described at home, m.")?;
    let soles = robot.soles().ok().map(|soles| format!("{soles:?}"));
    let soles = soles.map_or("None".to_owned(), |soles| format!("Some({soles})"));
    writeln!(out, "pub const SOLES: Option<[Sole<f32>; LEGS]> = {soles};\n")?;
    writeln!(
        out,
        "/// After a reset: diagonals of the gain matrices for position (1/s²), velocity (1/s),"
    )?;
    writeln!(out, "/// orientation (1/s²) and angular velocity (1/s).")?;
    writeln!(out, "pub const GAINS: [[f32; 3]; 4] = {:?};", gains(scene))?;
    writeln!(out, "/// The pose to hold after a reset: where the central body is (m), and its")?;
    writeln!(out, "/// quaternion, scalar first.")?;
    writeln!(out, "pub const POSITION: [f32; 3] = {:?};", pose.position)?;
    writeln!(
        out,
        "/// See `POSITION`.\npub const ORIENTATION: [f32; 4] = {:?};",
        pose.orientation
    )?;
    writeln!(out, "}}")
}

/// Of finite numbers, which read as they are written.
fn limits(robot: &Robot) -> String {
    with_tree!(&robot.tree, _tree, LEGS => {
        robot.limits.sized::<LEGS>().map_or_else(String::new, |limits| format!("{limits:?}"))
    }, _tree, ROWS => {
        robot.limits.in_rows::<ROWS>().map_or_else(String::new, |limits| format!("{limits:?}"))
    })
}

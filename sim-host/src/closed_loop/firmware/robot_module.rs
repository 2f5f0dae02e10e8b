//! A robot as the firmware takes it: the last module of its `robot.rs`.
//!
//! Limits, soles and gains are derived here from the robot's file and scene, and nowhere else: the firmware finds them
//! as constants.

use super::{folder_name, gains, set_point};
use crate::closed_loop::standing::feet;
use crate::robot::{LEG, Robot};
use crate::scene::Scene;
use std::fmt::Write;
use surefoot::balance::WholeBodyFoot;
use surefoot_robots::tree_source;

/// The module's text, of the robot that a scene reads from a file, with the scene's gains and set point; `None` for a
/// scene of another robot, and for one without limits for its joints.
pub fn robot_module(scene: &Scene) -> Option<String> {
    let robot = scene.robot();
    let fingerprint = robot.id()?.fingerprint;
    let tree = tree_source(scene.robot.as_ref()?.described()?);
    let mut out = String::new();
    let is_six_jointed = robot.tree.is_six_jointed();
    let write = if is_six_jointed { six_jointed } else { whole_body };
    // Writing to a string does not fail.
    head(&mut out, &robot, is_six_jointed, fingerprint).ok()?;
    write(&mut out, &robot, &tree).ok()?;
    tail(&mut out, scene).ok()?;
    Some(out)
}

fn head(
    out: &mut String,
    robot: &Robot,
    is_six_jointed: bool,
    fingerprint: u32,
) -> std::fmt::Result {
    writeln!(out, "\n/// What the firmware balances.")?;
    writeln!(out, "#[rustfmt::skip]\npub mod firmware {{")?;
    let uses = if is_six_jointed {
        "use surefoot::balance::{JointDamping, JointLimits, LeggedRobot, SafetyLimits, Sole, Thresholds};"
    } else {
        "use surefoot::balance::{ContactLimits, ContactPatch, JointDamping, JointLimits};\n\
         use surefoot::balance::{SafetyLimits, Thresholds, WholeBodyFoot};\n\
         use surefoot::spatial::{Quaternion, Vector3};"
    };
    writeln!(out, "{uses}\nuse surefoot::model::{{Link, Tree}};\n")?;
    writeln!(out, "/// Its images are in the folder `target/firmware` below this name.")?;
    writeln!(out, "pub const NAME: &str = {:?};", folder_name(robot))?;
    writeln!(out, "/// Of the robot and `LIMITS`, by which the other end of the link knows them.")?;
    writeln!(out, "pub const FINGERPRINT: u32 = {fingerprint:#010x};")
}

/// Of a robot on legs of six joints, everything else locked.
fn six_jointed(out: &mut String, robot: &Robot, tree: &str) -> std::fmt::Result {
    let (legs, joints) = (robot.leg_count(), robot.joint_count());
    let size = format!("{}, {}, {}", joints + 1, joints + 7, joints + 6);
    writeln!(out, "/// Legs of six revolute joints.\npub const LEGS: usize = {legs};\n")?;
    writeln!(out, "/// Of the legs' joints.\npub const TREE: Tree<f64, {size}> = {tree};\n")?;
    writeln!(out, "/// As the balance controller takes it.")?;
    let sized = "LeggedRobot::<f64, LEGS>::new(&TREE).to_f32()";
    writeln!(out, "pub const ROBOT: LeggedRobot<f32, LEGS> = {sized};\n")?;
    writeln!(out, "/// What its supervisor allows: messages may be tighter, and no wider.")?;
    let limits = limits(robot);
    writeln!(out, "pub const LIMITS: SafetyLimits<f32, LEGS> = {limits}.to_f32();\n")?;
    writeln!(
        out,
        "/// Its soles, if they are rectangles: origin at the last joint, axes as the robot"
    )?;
    writeln!(out, "/// is described at home, m.")?;
    let soles = robot.soles().ok().map(|soles| format!("{soles:?}"));
    let soles = soles.map_or("None".to_owned(), |soles| format!("Some({soles})"));
    writeln!(out, "pub const SOLES: Option<[Sole<f32>; LEGS]> = {soles};\n")
}

/// Of any other one.
fn whole_body(out: &mut String, robot: &Robot, tree: &str) -> std::fmt::Result {
    let joints = robot.joint_count();
    let rows = joints.div_ceil(LEG);
    writeln!(out, "/// Joints, which are the tree's bodies but the central one.")?;
    writeln!(out, "pub const JOINTS: usize = {joints};")?;
    writeln!(out, "/// Bodies of the tree.\npub const NODES: usize = {};", joints + 1)?;
    writeln!(out, "/// Its coordinates.\npub const COORDINATES: usize = {};", joints + 7)?;
    writeln!(out, "/// Its velocities.\npub const VELOCITIES: usize = {};", joints + 6)?;
    writeln!(out, "/// Rows of six that the joints fill.\npub const ROWS: usize = {rows};\n")?;
    writeln!(
        out,
        "/// Of all joints.\n\
         pub const TREE: Tree<f32, NODES, COORDINATES, VELOCITIES> =\n    {tree}.to_f32();\n"
    )?;
    writeln!(out, "/// Its feet. What the ground gives them is said by a message.")?;
    let all = feet::<f32>(robot);
    writeln!(out, "pub const FEET: [Option<WholeBodyFoot<f32>>; {}] = [", all.len())?;
    for foot in &all {
        let Some(WholeBodyFoot { body, reference, axes, limits }) = foot else {
            writeln!(out, "None,")?;
            continue;
        };
        let ([x, y, z], [s, a, b, c]) = ([reference.x, reference.y, reference.z], axes.to_array());
        writeln!(
            out,
            "Some(WholeBodyFoot {{\n    body: {body},\n    reference: Vector3::new({x:?}, {y:?}, {z:?}),\n    \
             axes: Quaternion {{ s: {s:?}, v: Vector3::new({a:?}, {b:?}, {c:?}) }},\n    \
             limits: ContactLimits {{\n        least_force: 0.0,\n        greatest_force: 0.0,\n        \
             friction: 0.0,\n        patch: ContactPatch::<f32>::centered({:?}),\n        \
             torques: [],\n    }},\n}}),",
            limits.patch.half_lengths()
        )?;
    }
    writeln!(out, "];\n")?;
    writeln!(out, "/// What its supervisor allows: messages may be tighter, and no wider.")?;
    let limits = limits(robot);
    writeln!(out, "pub const LIMITS: SafetyLimits<f32, ROWS> = {limits}.to_f32();\n")
}

fn tail(out: &mut String, scene: &Scene) -> std::fmt::Result {
    let pose = set_point(scene);
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

/// In as many rows of six as its joints fill, of finite numbers, which read as they are written.
fn limits(robot: &Robot) -> String {
    fn of<const ROWS: usize>(robot: &Robot) -> String {
        robot.limits.in_rows::<ROWS>().map_or_else(String::new, |limits| format!("{limits:?}"))
    }
    match robot.joint_count().div_ceil(LEG) {
        0 | 1 => of::<1>(robot),
        2 => of::<2>(robot),
        3 => of::<3>(robot),
        4 => of::<4>(robot),
        5 => of::<5>(robot),
        6 => of::<6>(robot),
        _ => of::<7>(robot),
    }
}

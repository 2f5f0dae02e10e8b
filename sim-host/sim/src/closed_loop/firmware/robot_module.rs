//! A robot as the firmware takes it: the last module of its `robot.rs`.
//!
//! Limits, soles and gains are derived here from the robot's file and scene, and nowhere else: the firmware finds them
//! as constants.

use super::{folder_name, gains, set_point};
use crate::closed_loop::whole_body_settings::{feet, legs_id, tree_id};
use crate::robot::{LEG, Robot};
use crate::scene::Scene;
use std::fmt::Write;
use surefoot::balance::WholeBodyFoot;
use surefoot_robots::tree_source;

/// The module's text, of the robot that a scene reads from a file, with the scene's gains and set point; `None` for a
/// scene of another robot, and for one without limits for its joints.
pub fn robot_module(scene: &Scene) -> Option<String> {
    let robot = scene.robot();
    let legs = robot.tree.is_six_jointed().then(|| legs_id(&robot));
    let legs = legs.flatten();
    let tree = tree_source(scene.robot.as_ref()?.described()?);
    let mut out = String::new();
    // Writing to a string does not fail.
    head(&mut out, &robot, legs.is_some()).ok()?;
    if let Some(id) = legs {
        six_jointed(&mut out, &robot, &tree, id.fingerprint).ok()?;
    }
    tail(&mut out, scene).ok()?;
    let limits = limits(&robot);
    out += &whole_body_module(&robot, "", [&tree, &limits])?;
    Some(out)
}

/// The last module of a robot's `robot.rs`: the robot as the whole-body controller takes it, of robots with other
/// legs than of six joints, or that move more, or that walk. What else it uses, and the expressions of its tree and of
/// its supervisor's limits, in f64; `None` for a robot without limits for its joints.
pub fn whole_body_module(robot: &Robot, uses: &str, expressions: [&str; 2]) -> Option<String> {
    let mut out = String::new();
    whole_body(&mut out, robot, uses, expressions).ok()?;
    Some(out)
}

fn head(out: &mut String, robot: &Robot, is_six_jointed: bool) -> std::fmt::Result {
    writeln!(out, "\n/// What the firmware balances.")?;
    writeln!(out, "#[rustfmt::skip]\npub mod firmware {{")?;
    if is_six_jointed {
        writeln!(
            out,
            "use surefoot::balance::{{JointDamping, JointLimits, LeggedRobot, SafetyLimits, Sole, Thresholds}};\n\
             use surefoot::model::{{Link, Tree}};\n"
        )?;
    }
    writeln!(out, "/// Its images are in the folder `target/firmware` below this name.")?;
    writeln!(out, "pub const NAME: &str = {:?};", folder_name(robot))
}

/// Of a robot on legs of six joints, everything else locked.
fn six_jointed(out: &mut String, robot: &Robot, tree: &str, fingerprint: u32) -> std::fmt::Result {
    let (legs, joints) = (robot.leg_count(), robot.joint_count());
    let size = format!("{}, {}, {}", joints + 1, joints + 7, joints + 6);
    writeln!(out, "/// Of `ROBOT` and `LIMITS`, by which the other end of the link knows them.")?;
    writeln!(out, "pub const FINGERPRINT: u32 = {fingerprint:#010x};")?;
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

fn whole_body(
    out: &mut String,
    robot: &Robot,
    uses: &str,
    [tree, limits]: [&str; 2],
) -> std::fmt::Result {
    let fingerprint = tree_id(robot).ok_or(std::fmt::Error)?.fingerprint;
    let joints = robot.joint_count();
    let rows = joints.div_ceil(LEG);
    writeln!(out, "\n/// The same for the whole-body controller, which walks too.")?;
    writeln!(out, "#[rustfmt::skip]\npub mod whole_body {{")?;
    writeln!(
        out,
        "#[allow(unused_imports)]\n\
         use surefoot::balance::{{ContactLimits, ContactPatch, JointDamping, JointLimits}};\n\
         #[allow(unused_imports)]\n\
         use surefoot::balance::{{SafetyLimits, Thresholds, WholeBodyFoot}};\n\
         #[allow(unused_imports)]\n\
         use surefoot::model::{{Link, Tree}};\n\
         use surefoot::spatial::{{Quaternion, Vector3}};\n{uses}"
    )?;
    writeln!(out, "/// Of all below, by which the other end of the link knows them.")?;
    writeln!(out, "pub const FINGERPRINT: u32 = {fingerprint:#010x};")?;
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
    writeln!(out, "pub const LIMITS: SafetyLimits<f32, ROWS> = {limits}.to_f32();\n}}")
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

//! A scene in which a robot from a file stands: what `surefoot import` writes beside the robot.

use super::{Robot, stance};
use std::fmt::Write;
use surefoot::balance::WholeBodySettings;
use surefoot::model::robots::biped;
use surefoot::spatial::Quaternion;
use surefoot_multibody::contact::Floor;

/// Points of the biped's feet, whose floor this one is like.
const BIPED_POINTS: f64 = 8.0;
/// Friction of rubber on a dry floor.
const FRICTION: f64 = 0.6;
/// Of the biped's motions in place, 1/s² and 1/s; by Froude's similarity for another height.
const POSITION_GAIN: [f64; 3] = [50.0, 50.0, 200.0];
const ORIENTATION_GAIN: f64 = 50.0;
/// As much as of the biped's experiments: damping ratio 0.5.
const DAMPING_RATIO: f64 = 0.5;

/// The text of a scene in which the robot of `file` stands for 3 s on bent legs, from a rest on the floor; `None` where
/// its legs find no such angles.
pub fn stand_scene(robot: &Robot, file: &str) -> Option<String> {
    let angles = stance::bent(robot)?;
    let mut out = String::new();
    // Writing to a string does not fail.
    write_scene(&mut out, robot, file, &angles).ok()?;
    Some(out)
}

fn write_scene(out: &mut String, robot: &Robot, file: &str, angles: &[f64]) -> std::fmt::Result {
    let height = stance::on_floor(robot, angles, Quaternion::identity()).positions[2];
    let (mass, points) = (robot.tree.mass(), robot.points_of_feet().iter().sum::<usize>());
    writeln!(out, "# Written by `surefoot import`. docs/robots.md says what may stand here.")?;
    writeln!(out, "description = {:?}", format!("{} stands on bent legs", robot.name))?;
    writeln!(out, "duration_s = 3.0\n")?;
    writeln!(out, "[robot]\nfile = {file:?}")?;
    writeln!(out, "\n[integrator]\nname = \"variational\"\nstep_s = 1e-3\n")?;
    writeln!(
        out,
        "# the lowest point of its feet is on the floor, and it is held where it starts"
    )?;
    writeln!(out, "[initial.joints_deg]")?;
    for (joint, angle) in robot.joints.iter().zip(angles) {
        writeln!(out, "{} = {:.4}", key(joint), angle.to_degrees())?;
    }
    let time = (height / super::limits::BIPED_HEIGHT).sqrt();
    match robot.tree.is_six_jointed() {
        true => six_jointed(out, time)?,
        false => whole_body(out, height, robot.tree.gravity().norm())?,
    }
    // As deep and as damped under its weight, in its own times and lengths, as the biped's.
    let part = mass / biped::TREE.mass() * BIPED_POINTS / points.max(1) as f64;
    let (stiffness, damper) = (part / (time * time), part / time);
    let Floor { normal_stiffness, normal_damping, zero_velocity_threshold, .. } = Floor::RUBBER;
    writeln!(out, "\n[feet]\non = \"floor\"\n\n[feet.floor]")?;
    writeln!(out, "normal_stiffness = {:.1}", stiffness * normal_stiffness)?;
    writeln!(out, "normal_damping = {:.1}", damper * normal_damping)?;
    writeln!(out, "tangential_stiffness = {:.1}", stiffness * normal_stiffness)?;
    writeln!(out, "tangential_damping = {:.1}", damper * normal_damping)?;
    writeln!(out, "static_friction = {FRICTION}\ndynamic_friction = {FRICTION}")?;
    writeln!(out, "zero_velocity_threshold = {zero_velocity_threshold}")
}

/// The controller of legs of six joints, in times of the biped's.
fn six_jointed(out: &mut String, time: f64) -> std::fmt::Result {
    let position = POSITION_GAIN.map(|gain| gain / (time * time));
    let orientation = [ORIENTATION_GAIN / (time * time); 3];
    let damping = |gains: [f64; 3]| gains.map(|gain| 2.0 * DAMPING_RATIO * gain.sqrt());
    writeln!(out, "\n[controller]\nrate_hz = 500.0")?;
    writeln!(out, "position_gain = {}", list(position))?;
    writeln!(out, "velocity_gain = {}", list(damping(position)))?;
    writeln!(out, "orientation_gain = {}", list(orientation))?;
    writeln!(out, "angular_velocity_gain = {}", list(damping(orientation)))?;
    writeln!(out, "workspace = \"fixed-foot\"\ntorques_from = \"start\"")
}

/// The whole-body controller, at the starting values of core for a robot so high (m) under gravity (m/s²).
fn whole_body(out: &mut String, height: f64, gravity: f64) -> std::fmt::Result {
    let gains = WholeBodySettings::<f64, 6>::scaled(height, gravity, 1).gains;
    let same = |gain: surefoot::spatial::SymmetricMatrix3<f64>| list(gain.diagonal.into());
    writeln!(out, "\n# starting values: 10 g/z and 5.2 √(g/z) at the height z; docs/tuning.md")?;
    writeln!(out, "[controller]\nrate_hz = 500.0")?;
    writeln!(out, "position_gain = {}", same(gains.position))?;
    writeln!(out, "velocity_gain = {}", same(gains.velocity))?;
    writeln!(out, "orientation_gain = {}", same(gains.orientation))?;
    writeln!(out, "angular_velocity_gain = {}", same(gains.angular_velocity))?;
    writeln!(out, "workspace = \"fixed-foot\"\ndistribution = \"limited\"")?;
    writeln!(out, "torques_from = \"start\"")
}

/// A name as a key of TOML.
fn key(name: &str) -> String {
    let is_bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    match !name.is_empty() && name.chars().all(is_bare) {
        true => name.to_owned(),
        false => format!("\"{}\"", name.replace('\\', "\\\\").replace('"', "\\\"")),
    }
}

fn list(numbers: [f64; 3]) -> String {
    format!("[{:.3}, {:.3}, {:.3}]", numbers[0], numbers[1], numbers[2])
}

//! The robot of a scene from a file, and where it starts.

use super::check::wrong;
use super::{Initial, Scene, SceneError, SetPoint};
use crate::robot::{Robot, SharedRobot, stance};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use surefoot::spatial::Quaternion;
use surefoot_robots::{Options, Robot as Described, import, robot_toml};

/// The robot of a scene. All its joints move but those that are locked.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RobotEntry {
    /// A robot.toml, URDF or MJCF file; relative to the scene's folder.
    pub file: String,
    /// Joints that are locked, and where: rad, or m.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub lock: BTreeMap<String, f64>,
    /// Links that stand on the floor; those of the file, or that are found in it, unless said.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub feet: Vec<String>,
    /// What the file said when it was read, in short: a motion is of this robot.
    #[serde(skip_deserializing)]
    content: String,
    #[serde(skip)]
    loaded: Loaded,
}

/// What was read; robots are compared by their content.
#[derive(Clone, Debug, Default)]
struct Loaded(Option<Arc<Read>>);

#[derive(Debug)]
struct Read {
    path: PathBuf,
    described: Described,
    robot: SharedRobot,
}

impl PartialEq for Loaded {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl RobotEntry {
    /// The robot; `None` before the scene was read.
    pub(super) fn robot(&self) -> Option<SharedRobot> {
        self.loaded.0.as_ref().map(|read| read.robot.clone())
    }

    /// The same as its file describes it, with what is locked lumped into what carries it.
    pub fn described(&self) -> Option<&Described> {
        self.loaded.0.as_ref().map(|read| &read.described)
    }

    /// The file that was read.
    pub fn path(&self) -> Option<&Path> {
        self.loaded.0.as_ref().map(|read| read.path.as_path())
    }
}

/// Reads the robot's file, and finds where it starts and what it holds; nothing for a scene of the biped.
pub(super) fn resolve(
    scene: &mut Scene,
    folder: Option<&Path>,
    has_set_point: bool,
) -> Result<(), SceneError> {
    let Some(entry) = &scene.robot else { return Ok(()) };
    let path = folder.unwrap_or(Path::new("")).join(&entry.file);
    let options = Options {
        locks: entry.lock.iter().map(|(name, at)| (name.clone(), *at)).collect(),
        feet: entry.feet.clone(),
        find_feet: true,
        ..Options::default()
    };
    let refuse = |expected: String| wrong(scene, "robot.file", &entry.file, expected);
    let imported =
        import(&path, &options).map_err(|error| refuse(format!("a robot file: {error}")))?;
    let robot = Robot::of_file(&imported.robot).map_err(|error| refuse(error.to_string()))?;
    let robot = Arc::new(robot);
    let content = short(&robot_toml(&imported.robot));
    let state = start(scene, &robot)?;
    if !has_set_point {
        let [x, y, z, q @ ..] = std::array::from_fn::<_, 7, _>(|i| state.positions[i]);
        scene.set_point = SetPoint { position_m: [x, y, z], orientation: q };
    }
    if let Initial::Joints(start) = &mut scene.initial {
        start.state = state;
    }
    if let Some(entry) = &mut scene.robot {
        let described = imported.robot;
        (entry.content, entry.loaded) =
            (content, Loaded(Some(Arc::new(Read { path, described, robot }))));
    }
    Ok(())
}

/// The robot's state where the scene has it start.
fn start(scene: &Scene, robot: &Robot) -> Result<crate::plant::PlantState, SceneError> {
    let Initial::Joints(initial) = &scene.initial else {
        return Ok(crate::plant::PlantState::home(robot.joint_count()));
    };
    let mut angles = vec![0.0; robot.joint_count()];
    for (name, degrees) in &initial.joints_deg {
        let field = format!("initial.joints_deg.{name}");
        let Some(joint) = robot.joints.iter().position(|joint| joint == name) else {
            let expected = format!("a joint of the robot: {}", robot.joints.join(", "));
            return Err(wrong(scene, &field, degrees, expected));
        };
        let [low, high] = robot.limits.joints[joint].angle.map(f64::to_degrees);
        if !(*degrees >= low && *degrees <= high) {
            let expected = format!("an angle within the joint's range, {low:.1} to {high:.1}");
            return Err(wrong(scene, &field, degrees, expected));
        }
        angles[joint] = degrees.to_radians();
    }
    let axis = Vector3::from(initial.turn_axis);
    if !(axis.norm() >= 1e-9) {
        let expected = "an axis with a length";
        return Err(wrong(scene, "initial.turn_axis", initial.turn_axis, expected));
    }
    let turned = Quaternion::from_axis_angle(axis.normalize(), initial.turn_deg.to_radians());
    let mut state = stance::on_floor(robot, &angles, turned);
    if !scene.terrain.is_level() {
        state.positions[2] += scene.terrain.raise(robot, &state);
    }
    state.positions[2] += initial.above_floor_m;
    Ok(state)
}

/// A text in sixteen digits (FNV-1a), the same for every compiler and machine.
fn short(text: &str) -> String {
    let hash = text.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    });
    format!("{hash:016x}")
}

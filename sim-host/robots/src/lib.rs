//! Robot files: URDF and MJCF in, a robot with names out, as a TOML file, as `const` data for firmware, and
//! as dynamics of a size that is known when the file is read.
//!
//! ```text
//! robot.urdf ─ urdf ┐
//! robot.xml  ─ mjcf ┴► Description ─ reduce, feet ─► Robot ◄─► robot.toml
//!                                                     │ ├─► robot.rs   (const tree, in flash)
//!                                                     │ └─► dynamics   (states of a file)
//! ```

mod description;
pub mod dynamics;
mod error;
mod feet;
mod hull;
mod inertial;
mod mesh;
mod mjcf;
mod reduce;
mod robot;
mod robot_file;
mod rust_source;
mod standing;
mod tree;
mod urdf;
mod xml;

pub use description::JointProperties;
pub use error::{ImportError, Place, Refusal};
pub use inertial::Inertial;
pub use robot::{Coupling, Foot, NamedFrame, Robot, RobotJoint, RobotLink, RobotMotion};
pub use robot_file::robot_toml;
pub use rust_source::{legs, robot_rs, tree_source};
pub use tree::core_links;

use description::Description;
use std::collections::BTreeMap;
use std::path::Path;

/// How a robot is imported.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// What carries the root link, where the file does not say.
    pub base: BaseChoice,
    /// Joints that are fixed, with their coordinate (rad, or m).
    pub locks: Vec<(String, f64)>,
    /// Links that stand on the floor.
    pub feet: Vec<String>,
    /// Soles that are stated, not taken from collision shapes.
    pub soles: Vec<Sole>,
    /// Where neither options nor the file name feet, take the lowest links that hang from the root by six revolute
    /// joints.
    pub find_feet: bool,
    /// Fix every joint that no foot hangs from.
    pub legs_only: bool,
    /// Take joints that follow others as free ones, and leave out constraints.
    pub free_couplings: bool,
}

/// What carries the root link.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BaseChoice {
    /// The file, or else: a root link named `world` is fixed, any other floats.
    #[default]
    Auto,
    /// The world.
    Fixed,
    /// Nothing.
    Floating,
}

/// A rectangle that a foot stands on, in the frame of its link.
#[derive(Clone, Debug, PartialEq)]
pub struct Sole {
    /// The link.
    pub link: String,
    /// x_min, x_max, y_min, y_max, z, m
    pub rectangle: [f64; 5],
}

/// A robot, and what the user should know of how it came about.
#[derive(Clone, Debug)]
pub struct Imported {
    /// The robot.
    pub robot: Robot,
    /// Choices and doubts, a sentence each.
    pub notes: Vec<String>,
    /// Joints that were locked, with their coordinates.
    pub locked: Vec<(String, f64)>,
    /// What the reader has passed over: element (`parent/tag`) or attribute (`tag@name`), and how often.
    pub unread: BTreeMap<String, usize>,
}

/// Reads a robot from a URDF or MJCF file (which it is, its root element says) or a `robot.toml`.
///
/// # Errors
/// [`ImportError`], with file and line where there is one.
pub fn import(path: &Path, options: &Options) -> Result<Imported, ImportError> {
    reduce::reduce(read(path)?, options)
}

fn read(path: &Path) -> Result<Description, ImportError> {
    if path.extension().is_some_and(|ending| ending == "toml") {
        return robot_file::read(path);
    }
    let root = xml::read(path)?;
    match root.tag.as_str() {
        "robot" => urdf::read(&root),
        "mujoco" => mjcf::read(root, path),
        _ => Err(root.malformed("<robot> of a URDF or <mujoco> of an MJCF", root.describe())),
    }
}

/// `; is NAME meant?`, where a name is near.
pub(crate) fn nearest<'a>(wrong: &str, names: impl Iterator<Item = &'a str>) -> String {
    let near = names.map(|name| (strsim::levenshtein(wrong, name), name)).min();
    match near {
        Some((distance, name)) if distance <= 2 + wrong.len() / 3 => format!("; is {name} meant?"),
        _ => String::new(),
    }
}

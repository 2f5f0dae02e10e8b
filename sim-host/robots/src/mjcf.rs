//! MJCF: <https://mujoco.readthedocs.io/en/stable/XMLreference.html>.
//!
//! What changes masses, frames and joints is read, or refused by name: defaults and classes, includes,
//! units of angles, inertias from geoms, frames. Contacts, tendons' forces, sensors and looks are not.

mod bodies;
mod compiler;
mod constraints;
mod defaults;
mod geoms;
mod includes;
mod orientation;

use crate::description::{DescribedBase, Description};
use crate::error::ImportError;
use crate::xml::Element;
use compiler::Compiler;
use defaults::Defaults;
use std::path::Path;

/// MuJoCo's gravity, m/s².
const GRAVITY: [f64; 3] = [0.0, 0.0, -9.81];

/// Reads the root element `<mujoco>` of the file at `path`.
pub(crate) fn read(mut root: Element, path: &Path) -> Result<Description, ImportError> {
    includes::expand(&mut root, path)?;
    includes::refuse_unsupported(&root)?;
    let compiler = Compiler::read(&root)?;
    let defaults = Defaults::read(&root)?;
    let name = root.attribute("model").unwrap_or("robot").to_owned();
    let mut gravity = GRAVITY;
    for option in root.all("option") {
        gravity = option.numbers("gravity")?.unwrap_or(gravity);
        for flag in option.all("flag") {
            if flag.attribute("gravity") == Some("disable") {
                gravity = [0.0; 3];
            }
        }
    }
    let mut found = bodies::read(&root, &compiler, &defaults)?;
    constraints::read(&root, &defaults, &mut found)?;
    constraints::efforts(&root, &defaults, &mut found)?;
    compiler.adjust(&mut found.links);
    let unread = root.unread();
    Ok(Description {
        name,
        base: DescribedBase::World,
        gravity,
        fixed_mass: 0.0,
        links: found.links,
        joints: found.joints,
        constraints: found.constraints,
        feet: Vec::new(),
        unread,
    })
}

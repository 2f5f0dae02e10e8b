//! Images of the firmware, one set a robot, where `cargo xtask firmware` leaves them.

use super::LinkError;
use crate::robot::Robot;
use crate::scene::Scene;
use std::path::{Path, PathBuf};

/// Folder of all images.
const IMAGES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../target/firmware");

/// The image for the emulator that is built for a scene's robot.
///
/// # Errors
/// [`LinkError::NoImage`], with the command that builds it.
pub fn image_for(scene: &Scene) -> Result<PathBuf, LinkError> {
    let robot = scene.robot();
    let walks = if scene.walk.is_empty() { "" } else { "-walks" };
    let folder = folder_name(&robot) + walks;
    let image = Path::new(IMAGES).join(folder).join("emulation.elf");
    if image.exists() {
        return Ok(image);
    }
    Err(LinkError::NoImage { robot: robot.name.clone(), image, command: command(scene) })
}

/// A robot's folder of images.
pub fn folder_name(robot: &Robot) -> String {
    let is_plain = |c: &char| c.is_ascii_alphanumeric() || "-_.".contains(*c);
    let name: String = robot.name.chars().map(|c| if is_plain(&c) { c } else { '_' }).collect();
    // Neither a hidden one, nor one above.
    match name.trim_start_matches('.') {
        "" => "robot".to_owned(),
        name => name.to_owned(),
    }
}

/// What builds a scene's robot's images.
pub(super) fn command(scene: &Scene) -> String {
    let walks = if scene.walk.is_empty() { "" } else { " --walks" };
    let Some(file) = scene.robot.as_ref().and_then(|entry| entry.path()) else {
        return format!("cargo xtask firmware{walks}");
    };
    if file.extension().is_some_and(|extension| extension == "toml") {
        let source = file.with_file_name("robot.rs");
        return format!("cargo xtask firmware{walks} --robot {}", source.display());
    }
    format!(
        "surefoot import {} --out DIR` and `cargo xtask firmware{walks} --robot DIR/robot.rs",
        file.display()
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_robots_are_plain_names_of_folders() {
        let robot = crate::scene::load("experiment-1").expect("built in").robot();
        for (name, folder) in [
            ("g1_29dof_rev_1_0", "g1_29dof_rev_1_0"),
            ("../up", "_up"),
            ("a robot/with\\all", "a_robot_with_all"),
            ("..", "robot"),
            ("", "robot"),
        ] {
            let robot = Robot { name: name.to_owned(), ..(*robot).clone() };
            assert_eq!(folder_name(&robot), folder);
        }
    }
}

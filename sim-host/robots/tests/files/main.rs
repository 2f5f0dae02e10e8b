//! Robot files written for one property each: what is read, what is refused and where.

mod couplings;
mod feet;
mod hostile;
mod mjcf;
mod robot_file;
mod urdf;

use std::path::{Path, PathBuf};
use surefoot_robots::{ImportError, Imported, Options, import};

/// A file of this test's own.
fn file(name: &str, text: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::write(&path, text).expect("a file below the target folder");
    path
}

fn read(name: &str, text: &str) -> Result<Imported, ImportError> {
    import(&file(name, text), &Options::default())
}

/// A link with a mass of 1 kg and an inertia of 0.1 kg m² about every axis.
const BODY: &str = r#"<inertial><mass value="1"/><inertia ixx=".1" iyy=".1" izz=".1" ixy="0" ixz="0" iyz="0"/></inertial>"#;

/// A URDF of these elements.
fn robot(content: &str) -> String {
    format!("<robot name=\"r\">\n{content}\n</robot>\n")
}

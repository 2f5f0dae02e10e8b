//! `cargo xtask c`: the controller of a robot as a library for C, with its headers.

use crate::firmware::Robot;
use crate::toolchain::Toolchain;
use crate::workspace;
use anyhow::{Context, Result, bail};
use clap::Args;
use std::path::{Path, PathBuf};

const PACKAGE: &str = "surefoot-c";
/// Joints of a leg.
const LEG: usize = 6;

/// Of which robot, for which machine.
#[derive(Args)]
pub struct Options {
    /// The robot.rs that `surefoot import` wrote; the robot of the text unless said.
    #[arg(long, value_name = "DIR/robot.rs")]
    robot: Option<PathBuf>,
    /// A target as rustc calls it, such as thumbv7em-none-eabihf (may be given several times, for an archive each);
    /// this machine unless said.
    #[arg(long, value_name = "TRIPLE")]
    target: Vec<String>,
}

/// Builds, and says where everything is.
pub fn run(options: &Options) -> Result<()> {
    let robot = match &options.robot {
        Some(file) => Robot::of_file(file)?,
        None => Robot::of_the_text()?,
    };
    let targets = options.target.iter().map(|target| Some(target.as_str()));
    let this_machine = options.target.is_empty().then_some(None);
    for target in targets.chain(this_machine) {
        for path in build(&robot, target)? {
            println!("{}", path.display());
        }
    }
    Ok(())
}

/// Builds the library of a robot, and puts it with its headers into `target/c/ROBOT/TARGET`.
///
/// # Returns
/// The paths of the files.
pub fn build(robot: &Robot, target: Option<&str>) -> Result<Vec<PathBuf>> {
    let legs = robot.legs().with_context(|| {
        format!(
            "the library for C balances a floating body on legs of six revolute joints alone, and {} is \
             another one; `surefoot import --legs-only` locks what no foot hangs from",
            robot.name()
        )
    })?;
    let cargo = match target {
        Some(target) => Toolchain::provide(target)?.cargo("build"),
        None => workspace::cargo(["build"]),
    };
    let cargo = cargo.args(["--release", "--package", PACKAGE]);
    let built = workspace::libraries(cargo.env("SUREFOOT_ROBOT", robot.source()))?;
    let folder = workspace::root().join("target/c").join(robot.name());
    let folder = folder.join(target.unwrap_or("host"));
    std::fs::create_dir_all(&folder)
        .with_context(|| format!("{} cannot be made", folder.display()))?;
    let mut files = Vec::new();
    let mut put = |path: PathBuf| files.push(path);
    for library in built {
        let is_ours = library.file_stem().is_some_and(|stem| stem == "libsurefoot_c");
        let is_for_c = library.extension().is_some_and(|end| end != "rlib" && end != "rmeta");
        if is_ours && is_for_c {
            put(copied(&library, &folder)?);
        }
    }
    if files.is_empty() {
        bail!("cargo has built no library for C");
    }
    let header = workspace::root().join("c/include/surefoot.h");
    files.push(copied(&header, &folder)?);
    files.push(copied(&workspace::root().join("c/cmake/surefoot-config.cmake"), &folder)?);
    files.push(written(&folder, "surefoot_robot.h", &robot_header(robot.name(), legs))?);
    let version = VERSION_OF_CMAKE.replace("@VERSION@", env!("CARGO_PKG_VERSION"));
    files.push(written(&folder, "surefoot-config-version.cmake", &version)?);
    Ok(files)
}

/// All packages of the workspace have one version.
const VERSION_OF_CMAKE: &str = include_str!("../../c/cmake/surefoot-config-version.cmake");

fn written(folder: &Path, name: &str, contents: &str) -> Result<PathBuf> {
    let file = folder.join(name);
    std::fs::write(&file, contents)
        .with_context(|| format!("{} cannot be written", file.display()))?;
    Ok(file)
}

fn copied(file: &Path, folder: &Path) -> Result<PathBuf> {
    let to = folder.join(file.file_name().context("a file with a name")?);
    std::fs::copy(file, &to)
        .with_context(|| format!("{} cannot be copied to {}", file.display(), to.display()))?;
    Ok(to)
}

/// The sizes of a robot.
fn robot_header(name: &str, legs: usize) -> String {
    format!(
        "/* The robot {name}. Made with the library: both belong together. */\n\
         #ifndef SUREFOOT_ROBOT_H\n#define SUREFOOT_ROBOT_H\n\n\
         #define SUREFOOT_LEGS {legs}\n#define SUREFOOT_JOINTS {}\n\n#endif\n",
        LEG * legs
    )
}

//! Where the workspace is, and cargo within it.

use crate::step::Step;
use anyhow::{Context, Result};
use serde::Deserialize;
use std::env;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// Folder of the workspace's manifest.
pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("xtask is a folder of the workspace")
}

/// A cargo command. It is the cargo that runs this program: rustup's, if it is one, sees to that.
pub fn cargo<A: Into<OsString>>(arguments: impl IntoIterator<Item = A>) -> Step {
    Step::new("cargo", arguments)
}

/// The tests of one file that wait, ignored, for what a stage provides. They are built with the whole
/// workspace, as all other tests are: a choice of packages would choose other features of what they
/// depend on, and compile everything again.
pub fn ignored_tests(file: &str) -> Step {
    cargo(["test", "--workspace", "--test", file, "--", "--ignored"])
}

/// How a program is built.
#[derive(Clone, Copy)]
pub enum Built {
    /// As it ships: minutes.
    Released,
    /// Like the tests, from what these are built of.
    WithTests,
}

/// Builds an example.
///
/// # Returns
/// The path of the program.
pub fn example(name: &str, built: Built) -> Result<PathBuf> {
    let how: &[&str] = match built {
        Built::Released => &["--release"],
        Built::WithTests => &["--workspace", "--profile", "test"],
    };
    let build = cargo(["build", "--example", name]).args(how.iter().copied());
    executables(build, [])?.into_iter().next().context("cargo has built no program")
}

/// The compiler that cargo uses here unless told otherwise.
pub fn rustc<A: Into<OsString>>(arguments: impl IntoIterator<Item = A>) -> Step {
    Step::new(env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()), arguments)
}

/// Sees to it that the compiler has the library of a target.
///
/// # Errors
/// What to do where it has not, and cannot be given it.
pub fn provide_target(target: &str) -> Result<()> {
    let folder = rustc(["--print", "target-libdir", "--target", target]).read()?;
    if std::fs::read_dir(folder.trim()).is_ok_and(|mut files| files.next().is_some()) {
        return Ok(());
    }
    Step::new("rustup", ["target", "add", target]).run().with_context(|| {
        format!("the compiler has no library for {target}, and rustup cannot bring it")
    })
}

/// What cargo says of each thing it has built.
#[derive(Deserialize)]
struct Message {
    executable: Option<PathBuf>,
    #[serde(default)]
    filenames: Vec<PathBuf>,
}

/// Builds, and asks cargo itself which executables came of it, so that no setting of target folders
/// needs to be known here. The `last` arguments come after all others.
///
/// # Returns
/// The paths of the executables.
pub fn executables<const N: usize>(build: Step, last: [&str; N]) -> Result<Vec<PathBuf>> {
    Ok(messages(build, last)?.into_iter().filter_map(|message| message.executable).collect())
}

/// The same of all files that came of it.
pub fn libraries(build: Step) -> Result<Vec<PathBuf>> {
    Ok(messages(build, [])?.into_iter().flat_map(|message| message.filenames).collect())
}

fn messages<const N: usize>(build: Step, last: [&str; N]) -> Result<Vec<Message>> {
    let build = build.args(["--message-format=json-render-diagnostics"]).args(last);
    let text = build.run_and_read()?;
    text.lines()
        .map(|line| Ok(serde_json::from_str::<Message>(line)?))
        .collect::<Result<Vec<_>>>()
        .with_context(|| format!("`{build}` wrote a message that cannot be read"))
}

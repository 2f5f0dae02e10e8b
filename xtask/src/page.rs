//! `cargo xtask page`: the controller and its plant in one page of a browser, which opens from the disk.

use crate::workspace;
use anyhow::{Context, Result};
use base64::prelude::{BASE64_STANDARD, Engine};
use std::path::{Path, PathBuf};

const TARGET: &str = "wasm32-unknown-unknown";
const PACKAGE: &str = "surefoot-web";

/// Builds, and says where the page is.
pub fn run() -> Result<()> {
    println!("{}", build()?.display());
    Ok(())
}

/// Builds the module, and puts it with the page's parts into one file.
///
/// # Returns
/// The path of the file, `target/page/surefoot.html`.
pub fn build() -> Result<PathBuf> {
    workspace::provide_target(TARGET)?;
    let cargo = workspace::cargo(["build", "--profile", "page", "--package", PACKAGE]);
    let built = workspace::libraries(cargo.args(["--target", TARGET]))?;
    let module = built
        .iter()
        .find(|file| file.extension().is_some_and(|end| end == "wasm"))
        .context("cargo has built no module of WebAssembly")?;
    let module =
        std::fs::read(module).with_context(|| format!("{} cannot be read", module.display()))?;
    let page = part("web/page/page.html")?
        .replace("/*{style}*/", &part("web/page/page.css")?)
        .replace("/*{view}*/", &part("sim-host/src/report/view.js")?)
        .replace("/*{live}*/", &part("web/page/live.js")?)
        .replace("{module}", &BASE64_STANDARD.encode(module));
    let folder = workspace::root().join("target/page");
    std::fs::create_dir_all(&folder)
        .with_context(|| format!("{} cannot be made", folder.display()))?;
    let file = folder.join("surefoot.html");
    std::fs::write(&file, page).with_context(|| format!("{} cannot be written", file.display()))?;
    Ok(file)
}

fn part(path: &str) -> Result<String> {
    let path = workspace::root().join(Path::new(path));
    std::fs::read_to_string(&path).with_context(|| format!("{} cannot be read", path.display()))
}

//! `surefoot show`

use super::{bad_input, say};
use clap::Parser;
use std::process::ExitCode;
use surefoot_sim::scene::{AnyScene, BUILT_IN, BuiltIn, nearest_built_in, parse};

/// Options of `show`.
#[derive(Debug, Parser)]
pub struct Options {
    /// A built-in scene (see `surefoot list`)
    scene: String,
    /// One JSON document instead of the scene's text
    #[arg(long)]
    json: bool,
}

/// Prints a built-in scene as the file that it is: `run` of that file gives the same bits.
pub fn show(options: &Options) -> ExitCode {
    match shown(options) {
        Ok(text) => say(&text, ExitCode::SUCCESS),
        Err(message) => bad_input(&message, options.json),
    }
}

fn shown(options: &Options) -> Result<String, String> {
    let name = &options.scene;
    let Some(BuiltIn { text, .. }) = BUILT_IN.iter().find(|scene| scene.name == *name) else {
        return Err(unknown(name));
    };
    if !options.json {
        return Ok((*text).to_owned());
    }
    let scene = parse(name, text).map_err(|error| error.to_string())?;
    let kind = match &scene {
        AnyScene::Robot(_) => "robot",
        AnyScene::Mechanism(_) => "mechanism",
    };
    let (_, description) = scene.names();
    let document = serde_json::json!({ "scene": name, "kind": kind, "description": description, "toml": text });
    Ok(format!("{document:#}\n"))
}

fn unknown(name: &str) -> String {
    let meant = match nearest_built_in(name) {
        Some(nearest) => format!(" (did you mean '{nearest}'?)"),
        None if std::path::Path::new(name).is_file() => {
            " (it is a file: `surefoot run` takes it as it is)".to_owned()
        }
        None => String::new(),
    };
    let names = BUILT_IN.map(|scene| scene.name).join(", ");
    format!("no built-in scene is called '{name}'{meant}; there are {names}")
}

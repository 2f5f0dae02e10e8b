//! `surefoot list`

use super::{bad_input, say};
use clap::Parser;
use std::fmt::Write;
use std::process::ExitCode;
use surefoot_mechanics::integrators::Method;
use surefoot_sim::scene::{AnyScene, built_in};

/// Options of `list`.
#[derive(Debug, Parser)]
pub struct Options {
    /// One JSON document instead of text
    #[arg(long)]
    json: bool,
}

const ROBOTS: [(&str, &str); 3] = [
    ("biped", "the dissertation's biped: 13 bodies, 18 degrees of freedom, 74.548 kg"),
    ("arm", "seven joints in series on a fixed base, one oblique, one prismatic (core only)"),
    ("branching", "a tree with prismatic, spherical, fixed and universal joints (core only)"),
];

/// Prints what there is.
pub fn list(options: &Options) -> ExitCode {
    let scenes = match built_in() {
        Ok(scenes) => scenes,
        Err(error) => return bad_input(&error.to_string(), options.json),
    };
    let scenes: Vec<(&str, &str)> = scenes.iter().map(AnyScene::names).collect();
    let methods: Vec<(String, String)> =
        Method::all().iter().map(|method| (method.name(), method.description())).collect();
    let methods: Vec<(&str, &str)> =
        methods.iter().map(|(name, line)| (name.as_str(), line.as_str())).collect();
    let groups: [(&str, &[(&str, &str)]); 3] =
        [("scenes", &scenes), ("integrators", &methods), ("robots", &ROBOTS)];
    let mut text = String::new();
    if options.json {
        let document: serde_json::Map<String, serde_json::Value> = groups
            .iter()
            .map(|(group, entries)| {
                let entries = entries
                    .iter()
                    .map(|(name, line)| serde_json::json!({ "name": name, "description": line }))
                    .collect();
                ((*group).to_owned(), entries)
            })
            .collect();
        text = format!("{:#}\n", serde_json::Value::Object(document));
    } else {
        for (group, entries) in groups {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{group}");
            for (name, line) in entries {
                let _ = writeln!(text, "  {name:<24} {line}");
            }
        }
    }
    say(&text, ExitCode::SUCCESS)
}

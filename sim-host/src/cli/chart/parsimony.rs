//! `surefoot chart parsimony`: what models of different size cost for one motion, and how far they are off.

use super::super::{bad_input, say};
use super::Options;
use super::ladder_table::LadderTable;
use crate::parsimony::{MechanismRung, Rung, climb, climb_mechanism};
use crate::scene::{AnyScene, open};
use indicatif::ProgressBar;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// What is climbed unless a scene is named: a robot, a tree in a plane with parts fixed to it, and a free body.
const SCENES: [&str; 3] = ["experiment-1", "hinged-chain", "box-drop"];

/// Climbs the ladders.
pub(super) fn chart_parsimony(options: &Options) -> ExitCode {
    let names = options.scene.as_deref().map_or(SCENES.to_vec(), |name| vec![name]);
    let (mut ladders, mut files) = (Vec::new(), Vec::new());
    for name in names {
        match ladder(name, &options.out, &mut files) {
            Ok((ladder, text)) => {
                if !options.json {
                    say(&text);
                }
                ladders.push(ladder);
            }
            Err(message) => return bad_input(&message, options.json),
        }
    }
    if options.json {
        let mut ladders = ladders.into_iter();
        let document = json!({
            "chart": "parsimony",
            "ladder": ladders.next(),
            "further": ladders.collect::<Vec<_>>(),
            "files": files,
        });
        say(&format!("{document:#}\n"));
    } else {
        for file in files {
            say(&format!("written: {}\n", file.display()));
        }
    }
    ExitCode::SUCCESS
}

/// A scene's ladder, and the same for people.
fn ladder(name: &str, out: &Path, files: &mut Vec<PathBuf>) -> Result<(Value, String), String> {
    let (ladder, table, written) = match open(name).map_err(|error| error.to_string())? {
        AnyScene::Robot(scene) => {
            let bar = ProgressBar::new(Rung::of(&scene).len() as u64);
            let ladder = climb(name, &scene, &|done| bar.set_position(done as u64));
            bar.finish_and_clear();
            let table = LadderTable::from(&ladder);
            (json!(ladder), table.text(), table.write(out, &ladder)?)
        }
        AnyScene::Mechanism(scene) => {
            let bar = ProgressBar::new(MechanismRung::of(&scene).len() as u64);
            let ladder = climb_mechanism(name, &scene, &|done| bar.set_position(done as u64))
                .map_err(|error| format!("{name}: {error}"))?;
            bar.finish_and_clear();
            let table = LadderTable::from(&ladder);
            (json!(ladder), table.text(), table.write(out, &ladder)?)
        }
    };
    files.extend(written);
    Ok((ladder, table + "\n"))
}

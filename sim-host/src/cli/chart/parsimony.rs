//! `surefoot chart parsimony`: what models of different size cost for one motion, and how far they are off.

use super::ladder_table::LadderTable;
use super::{Made, Options};
use crate::parsimony::{MechanismRung, Rung, climb, climb_mechanism};
use crate::report::plain_chapter;
use indicatif::ProgressBar;
use serde_json::{Value, json};
use surefoot_sim::scene::{AnyScene, open};

/// What is climbed unless a scene is named: a robot, a tree in a plane with parts fixed to it, and a free body.
const SCENES: [&str; 3] = ["experiment-1", "hinged-chain", "box-drop"];

/// Climbs the ladders.
pub(super) fn chart(options: &Options) -> Result<Made, String> {
    let names = options.scene.as_deref().map_or(SCENES.to_vec(), |name| vec![name]);
    let (mut text, mut files) = (String::new(), Vec::new());
    let (mut ladders, mut figures, mut headlines) = (Vec::new(), Vec::new(), Vec::new());
    for name in names {
        let (ladder, table) = climbed(name)?;
        let drawing = table.drawing()?;
        let written = table.write(&options.out, &ladder, &drawing)?;
        text += &(table.text() + "\n");
        headlines.push(table.headline());
        figures.push(table.figure(&drawing, &written));
        ladders.push(ladder);
        files.extend(written);
    }
    let (title, about) = (
        "No more model than a scene needs",
        "One motion with models of different size: what a step of each costs, and how far it is off.",
    );
    let headline = headlines.join(" ");
    let chapter = plain_chapter("parsimony", (title, headline), about, &figures, &[])
        .map_err(|error| error.to_string())?;
    let mut ladders = ladders.into_iter();
    let json = json!({
        "chart": "parsimony",
        "ladder": ladders.next(),
        "further": ladders.collect::<Vec<_>>(),
    });
    Ok(Made { text, json, files, chapter })
}

/// A scene's ladder, for programs and for people.
fn climbed(name: &str) -> Result<(Value, LadderTable), String> {
    Ok(match open(name).map_err(|error| error.to_string())? {
        AnyScene::Robot(scene) => {
            let bar = ProgressBar::new(Rung::of(&scene).len() as u64);
            let ladder = climb(name, &scene, &|done| bar.set_position(done as u64));
            bar.finish_and_clear();
            (json!(ladder), LadderTable::from(&ladder))
        }
        AnyScene::Mechanism(scene) => {
            let bar = ProgressBar::new(MechanismRung::of(&scene).len() as u64);
            let ladder = climb_mechanism(name, &scene, &|done| bar.set_position(done as u64))
                .map_err(|error| format!("{name}: {error}"))?;
            bar.finish_and_clear();
            (json!(ladder), LadderTable::from(&ladder))
        }
    })
}

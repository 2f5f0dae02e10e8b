//! `cargo xtask peers --loop`: the controller behind its C interface on MuJoCo's dynamics and contact, beside this
//! project's plant: the largest pushes of 0.1 s that are survived.

use super::RUN_LIMIT;
use crate::firmware::Robot;
use crate::step::Step;
use crate::workspace::Built;
use crate::{c_library, workspace};
use anyhow::{Context, Result};
use serde::Deserialize;
use serde_json::{Value, json};
use std::path::Path;

#[derive(Deserialize)]
struct Push {
    degrees: f64,
    impulse: f64,
}

#[derive(Deserialize)]
struct Ours {
    ours: Vec<Push>,
}

#[derive(Deserialize)]
struct Theirs {
    version: String,
    rows: Vec<Push>,
}

/// Of a scene of the robot that the library is for.
pub fn run(scene: &str, folder: &Path, python: &Path, as_json: bool) -> Result<()> {
    let files = c_library::build(&Robot::of_the_text()?, None)?;
    let is_shared = |path: &&std::path::PathBuf| {
        path.extension().is_some_and(|end| end == "so" || end == "dylib" || end == "dll")
    };
    let library = files.iter().find(is_shared).context("a shared library")?;
    let program = workspace::example("peers_loop", Built::WithTests)?;
    let ours = Step::new(program, [scene]).within(RUN_LIMIT).run_and_read()?;
    let model = folder.join("loop.json");
    std::fs::write(&model, &ours).with_context(|| format!("cannot write {}", model.display()))?;
    let script = workspace::root().join("tests/peers/mujoco_loop.py");
    let theirs = Step::new(python, [&script, library, &model]).within(RUN_LIMIT).run_and_read()?;
    let (Ours { ours }, Theirs { version, rows }) =
        (serde_json::from_str(&ours)?, serde_json::from_str(&theirs)?);
    if as_json {
        let rows: Vec<Value> = ours
            .iter()
            .zip(&rows)
            .map(|(ours, theirs)| {
                json!({ "degrees": ours.degrees, "surefoot": ours.impulse, "mujoco": theirs.impulse })
            })
            .collect();
        let document = json!({ "scene": scene, "mujoco": version, "pushes_n_s": rows });
        println!("{}", serde_json::to_string_pretty(&document)?);
        return Ok(());
    }
    println!("largest push of 0.1 s that is survived, N·s; scene {scene}, MuJoCo {version}");
    println!("{:>10}{:>12}{:>10}", "direction", "surefoot", "MuJoCo");
    for (ours, theirs) in ours.iter().zip(&rows) {
        println!("{:>9}°{:>12}{:>10}", ours.degrees, ours.impulse, theirs.impulse);
    }
    Ok(())
}

//! `surefoot chart stability --scene`: the limits of a control loop.

use super::super::{bad_input, say};
use super::{Options, limits_table as table};
use crate::scene::{AnyScene, Scene, open};
use crate::stability::loop_limits::{Cell, Criterion, Quantity, Store, Survey};
use indicatif::{ProgressBar, ProgressStyle};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

/// Finds the limits of a scene, and writes them.
pub(super) fn find_limits(name: &str, options: &Options) -> ExitCode {
    let scene = match open(name) {
        Ok(AnyScene::Robot(scene)) => *scene,
        Ok(AnyScene::Mechanism(scene)) => {
            let message = format!("{} is a mechanism that nobody controls", scene.name);
            return bad_input(&message, options.json);
        }
        Err(error) => return bad_input(&error.to_string(), options.json),
    };
    let quantities = match options.only.as_slice() {
        [] => &Quantity::ALL,
        only => only,
    };
    let survey = Survey { scene: &scene, quantities, criterion: Criterion::default() };
    match find(&survey, options).and_then(|cells| {
        let files = write_files(&options.out, &survey, &cells)?;
        Ok((cells, files))
    }) {
        Ok((cells, files)) => {
            if options.json {
                say(&format!("{:#}\n", table::json(&survey, &cells)));
            } else {
                say(&table::text(&survey, &cells));
                for file in files {
                    say(&format!("written: {}\n", file.display()));
                }
            }
            ExitCode::SUCCESS
        }
        Err(message) => bad_input(&message, options.json),
    }
}

/// Takes up what an earlier call has left, and finds the rest, with a bar over the cells.
fn find(survey: &Survey, options: &Options) -> Result<Vec<Cell>, String> {
    let folder = &options.out;
    std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let program = std::env::current_exe()
        .and_then(std::fs::read)
        .map_err(|error| format!("this program cannot read itself: {error}"))?;
    let path = named(folder, survey.scene, "cells.json");
    let store = Store::new(&path, survey.scene, &survey.criterion, &program);
    if options.fresh {
        store.forget().map_err(|error| error.to_string())?;
    }
    let known = store.finished().map_err(|error| error.to_string())?;
    let taken_up = survey.missing(&known);
    let all = survey.work().len();
    if taken_up.len() < all {
        eprintln!("{} of {all} limits taken up from {}", all - taken_up.len(), path.display());
    }
    let bar = bar(all);
    let cells = survey
        .find(&store, &|done, _| bar.set_position(done as u64))
        .map_err(|error| error.to_string());
    bar.finish_and_clear();
    cells
}

fn bar(all: usize) -> ProgressBar {
    let bar = ProgressBar::new(all as u64);
    // The template is constant and valid; were it not, the default style would do.
    if let Ok(style) = ProgressStyle::with_template("limits {wide_bar} {pos}/{len} {elapsed}") {
        bar.set_style(style);
    }
    bar.enable_steady_tick(Duration::from_millis(500));
    bar
}

fn named(folder: &Path, scene: &Scene, ending: &str) -> PathBuf {
    folder.join(format!("limits-{}.{ending}", scene.name))
}

fn write_files(folder: &Path, survey: &Survey, cells: &[Cell]) -> Result<Vec<PathBuf>, String> {
    let csv = named(folder, survey.scene, "csv");
    let json = named(folder, survey.scene, "json");
    table::write_csv(&csv, survey, cells).map_err(|error| format!("{}: {error}", csv.display()))?;
    std::fs::write(&json, format!("{:#}\n", table::json(survey, cells)))
        .map_err(|error| format!("{}: {error}", json.display()))?;
    Ok(vec![csv, json])
}

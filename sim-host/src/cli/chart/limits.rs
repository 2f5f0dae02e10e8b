//! `surefoot chart stability --scene`: the limits of a control loop.

use super::super::complain;
use super::{Made, Options, limits_table as table, this_program};
use crate::report::plain_chapter;
use crate::stability::loop_limits::{Cell, Criterion, Loop, Quantity, Store, Survey};
use indicatif::{ProgressBar, ProgressStyle};
use serde_json::json;
use std::path::{Path, PathBuf};
use std::time::Duration;
use surefoot_sim::scene::{AnyScene, Scene, open};
use surefoot_sim::written::write_text;

/// Scenes whose limits are on the page of all charts.
pub(super) const SCENES: [&str; 2] = ["experiment-1", "experiment-2"];

/// Finds the limits of scenes, and writes them.
pub(super) fn chart(names: &[&str], options: &Options) -> Result<Made, String> {
    let (mut text, mut documents) = (String::new(), Vec::new());
    let (mut files, mut tables, mut lines) = (Vec::new(), Vec::new(), Vec::new());
    for name in names {
        let scene = robot(name)?;
        let quantities = match options.only.as_slice() {
            [] => &Quantity::ALL,
            only => only,
        };
        let criterion = Criterion::default();
        let survey = Survey { scene: &scene, quantities, loops: &Loop::BOTH, criterion };
        let cells = find(&survey, options)?;
        let written = write_files(&options.out, &survey, &cells)?;
        text += &table::text(&survey, &cells);
        lines.push(table::in_a_line(&survey, &cells));
        documents.push(table::json(&survey, &cells));
        let names = written.iter().filter_map(|f| Some(f.file_name()?.to_string_lossy().into()));
        tables.push(table::for_page(&survey, &cells, names.collect()));
        files.extend(written);
    }
    let json = match documents.len() {
        1 => documents.remove(0),
        _ => json!({ "chart": "loop-limits", "scenes": documents }),
    };
    let headline = lines.join("; ") + ".";
    let about = "How far one quantity of a scene can go, all others as they are, before the robot no longer stands.";
    let chapter =
        plain_chapter("limits", ("Limits of the control loop", headline), about, &[], &tables)
            .map_err(|error| error.to_string())?;
    Ok(Made { text, json, files, chapter })
}

fn robot(name: &str) -> Result<Scene, String> {
    match open(name) {
        Ok(AnyScene::Robot(scene)) => Ok(*scene),
        Ok(AnyScene::Mechanism(scene)) => {
            Err(format!("{} is a mechanism that nobody controls", scene.name))
        }
        Err(error) => Err(error.to_string()),
    }
}

/// Takes up what an earlier call has left, and finds the rest, with a bar over the cells.
fn find(survey: &Survey, options: &Options) -> Result<Vec<Cell>, String> {
    let folder = &options.out;
    let program = this_program()?;
    let path = named(folder, survey.scene, "cells.json");
    let store = Store::new(&path, survey.scene, &survey.criterion, &program);
    if options.fresh {
        store.forget().map_err(|error| error.to_string())?;
    }
    let known = store.finished().map_err(|error| error.to_string())?;
    let taken_up = survey.missing(&known);
    let all = survey.work().len();
    if taken_up.len() < all {
        let taken_up = all - taken_up.len();
        complain(format_args!("{taken_up} of {all} limits taken up from {}", path.display()));
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
    table::write_csv(&csv, survey, cells)?;
    write_text(&json, &format!("{:#}\n", table::json(survey, cells)))?;
    Ok(vec![csv, json])
}

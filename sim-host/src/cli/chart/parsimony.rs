//! `surefoot chart parsimony`: what models of different size cost for one motion, and how far they are off.

use super::{Made, Options};
use crate::chart::{Bar, Bars};
use crate::parsimony::{Ladder, Row, Rung, climb};
use crate::report::{Chapter, Figure, plain_chapter};
use crate::scene::load;
use clap::ValueEnum;
use indicatif::ProgressBar;
use serde_json::json;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Climbs the ladder of a scene: Experiment 1's, unless one is named.
pub(super) fn chart(options: &Options) -> Result<Made, String> {
    let name = options.scene.as_deref().unwrap_or("experiment-1");
    let scene = load(name).map_err(|error| error.to_string())?;
    let bar = ProgressBar::new(Rung::of(&scene).len() as u64);
    let ladder = climb(name, &scene, &|done| bar.set_position(done as u64));
    bar.finish_and_clear();
    let drawing = Bars::svg(&panels(&ladder)).map_err(|error| error.to_string())?;
    let files = write_files(&options.out, &ladder, &drawing)?;
    Ok(Made {
        text: text(&ladder),
        json: json!({ "chart": "parsimony", "ladder": ladder }),
        chapter: chapter(&ladder, &drawing, &files)?,
        files,
    })
}

fn chapter(ladder: &Ladder, drawing: &str, files: &[PathBuf]) -> Result<Chapter, String> {
    let names = files.iter().filter_map(|file| Some(file.file_name()?.to_string_lossy().into()));
    let figure = Figure::new(
        drawing,
        headline(ladder),
        "Afloat: limbs in motion without gravity. Deviations are of the central body, at most, from the largest \
         model of the same motion.",
    );
    let (title, about) = (
        "No more model than a scene needs",
        "One motion with models of different size: what a step of each costs, and how far it is off.",
    );
    let figures = [figure.with_files(names)];
    plain_chapter("parsimony", (title, headline(ladder)), about, &figures, &[])
        .map_err(|error| error.to_string())
}

/// What the ladder comes to.
fn headline(ladder: &Ladder) -> String {
    let cost = |rung| ladder.rows.iter().find(|row: &&Row| row.rung == rung)?.instructions;
    let saves = cost(Rung::FloorFull).zip(cost(Rung::FloorLumped)).map(|(full, lumped)| {
        format!(
            " On the floor the lumped model takes {lumped} instructions a step, the full one {full}: {:.2} times \
             as many.",
            full as f64 / lumped as f64
        )
    });
    format!(
        "{} runs on the {} model: {}.{}",
        ladder.scene,
        ladder.chosen.model,
        ladder.chosen.reason,
        saves.unwrap_or_default()
    )
}

fn word(rung: Rung) -> String {
    rung.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
}

fn text(ladder: &Ladder) -> String {
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = writeln!(
        out,
        "{}: one motion on every rung; afloat, limbs in motion without gravity.\n\
         Deviation of the central body, at most, from the rung that is named.\n\n  \
         {:<20}{:>7}{:>10}{:>14}{:>10}{:>12}{:>12}  from",
        ladder.scene, "", "bodies", "unknowns", "instructions", "µs/step", "m", "rad"
    );
    let dash = || "–".to_owned();
    for row in &ladder.rows {
        let _ = writeln!(
            out,
            "  {:<20}{:>7}{:>10}{:>14}{:>10}{:>12}{:>12}  {}",
            word(row.rung),
            row.bodies,
            row.unknowns.map_or_else(dash, |n| n.to_string()),
            row.instructions.map_or_else(dash, |n| n.to_string()),
            row.us_per_step.map_or_else(dash, |t| format!("{t:.2}")),
            row.deviation_m.map_or_else(dash, |m| format!("{m:.1e}")),
            row.deviation_rad.map_or_else(dash, |a| format!("{a:.1e}")),
            word(row.reference),
        );
    }
    let mut failures: Vec<String> = Vec::new();
    for row in &ladder.rows {
        if let Some(failure) = &row.failure {
            failures.push(format!("  {}: {failure}", word(row.rung)));
        }
    }
    failures.dedup_by(|a, b| a.split_once(": ").map(|x| x.1) == b.split_once(": ").map(|x| x.1));
    for failure in failures {
        let _ = writeln!(out, "{failure}");
    }
    let _ = writeln!(
        out,
        "\n`surefoot run` takes the {} model: {}.",
        ladder.chosen.model, ladder.chosen.reason
    );
    out
}

fn write_files(folder: &Path, ladder: &Ladder, drawing: &str) -> Result<Vec<PathBuf>, String> {
    let named = |ending: &str| folder.join(format!("parsimony-{}.{ending}", ladder.scene));
    let (csv, json, svg) = (named("csv"), named("json"), named("svg"));
    let context =
        |path: &Path, error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let mut writer = csv::Writer::from_path(&csv).map_err(|error| context(&csv, &error))?;
    for row in &ladder.rows {
        writer.serialize(row).map_err(|error| context(&csv, &error))?;
    }
    writer.flush().map_err(|error| context(&csv, &error))?;
    let document = serde_json::to_string_pretty(ladder).map_err(|error| context(&json, &error))?;
    std::fs::write(&json, document + "\n").map_err(|error| context(&json, &error))?;
    std::fs::write(&svg, drawing).map_err(|error| context(&svg, &error))?;
    Ok(vec![csv, json, svg])
}

fn panels(ladder: &Ladder) -> Vec<Bars> {
    let bars = |value: &dyn Fn(&Row) -> Option<f64>, label: &dyn Fn(f64) -> String| {
        let bar = |row: &Row| Bar {
            name: word(row.rung),
            value: value(row),
            label: value(row).map_or_else(|| "–".to_owned(), label),
        };
        ladder.rows.iter().map(bar).collect::<Vec<_>>()
    };
    let scene = &ladder.scene;
    let mut panels = Vec::new();
    if ladder.rows.iter().any(|row| row.instructions.is_some()) {
        let counts = bars(&|row| row.instructions.map(|n| n as f64), &|n| format!("{n:.0}"));
        panels.push(Bars::new(format!("{scene}: instructions per step"), counts));
    }
    let times = bars(&|row| row.us_per_step, &|t| format!("{t:.2}"));
    panels.push(Bars::new(format!("{scene}: time per step, µs"), times));
    let unknowns = bars(&|row| row.unknowns.map(|n| n as f64), &|n| format!("{n:.0}"));
    panels.push(Bars::new(format!("{scene}: unknowns"), unknowns));
    let deviations = bars(&|row| row.deviation_m, &|m| format!("{m:.1e}"));
    let title =
        format!("{scene}: deviation of the central body from the full model, m (logarithmic)");
    panels.push(Bars::new(title, deviations).logarithmic());
    panels
}

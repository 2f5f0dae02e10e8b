//! `surefoot chart parsimony`: what models of different size cost for one motion, and how far they are off.

use super::super::{bad_input, say};
use super::Options;
use crate::chart::{Bar, Bars};
use crate::parsimony::{Ladder, Row, Rung, Saving, climb};
use crate::scene::load;
use clap::ValueEnum;
use indicatif::ProgressBar;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Climbs the ladder of a scene: Experiment 1's, unless one is named.
pub(super) fn chart_parsimony(options: &Options) -> ExitCode {
    let name = options.scene.as_deref().unwrap_or("experiment-1");
    let scene = match load(name) {
        Ok(scene) => scene,
        Err(error) => return bad_input(&error.to_string(), options.json),
    };
    let bar = ProgressBar::new(Rung::of(&scene).len() as u64);
    let ladder = climb(name, &scene, &|done| bar.set_position(done as u64));
    bar.finish_and_clear();
    let files = match write_files(&options.out, &ladder) {
        Ok(files) => files,
        Err(message) => return bad_input(&message, options.json),
    };
    if options.json {
        let document =
            serde_json::json!({ "chart": "parsimony", "ladder": ladder, "files": files });
        say(&format!("{document:#}\n"));
    } else {
        say(&text(&ladder));
        for file in files {
            say(&format!("written: {}\n", file.display()));
        }
    }
    ExitCode::SUCCESS
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
    for saving in &ladder.savings {
        let _ = writeln!(out, "\n{}", sentence(saving));
    }
    let _ = writeln!(
        out,
        "\n`surefoot run` takes the {} model: {}.",
        ladder.chosen.model, ladder.chosen.reason
    );
    out
}

/// What lumping saves, and why no more.
fn sentence(saving: &Saving) -> String {
    let Saving { full, lumped, share, bodies, each, common, each_for_half } = *saving;
    format!(
        "{} takes {:.0} % of {}: {bodies} bodies go, at {each:.0} instructions each. {common:.0} are for what both \
         have (velocities,\ncontact points, constraints, the step itself), whatever bodies cost; for half, a body \
         would have to take {each_for_half:.0}.",
        word(lumped),
        100.0 * share,
        word(full),
    )
}

fn write_files(folder: &Path, ladder: &Ladder) -> Result<Vec<PathBuf>, String> {
    let named = |ending: &str| folder.join(format!("parsimony-{}.{ending}", ladder.scene));
    let (csv, json, svg) = (named("csv"), named("json"), named("svg"));
    let context =
        |path: &Path, error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    std::fs::create_dir_all(folder).map_err(|error| context(folder, &error))?;
    let mut writer = csv::Writer::from_path(&csv).map_err(|error| context(&csv, &error))?;
    for row in &ladder.rows {
        writer.serialize(row).map_err(|error| context(&csv, &error))?;
    }
    writer.flush().map_err(|error| context(&csv, &error))?;
    let document = serde_json::to_string_pretty(ladder).map_err(|error| context(&json, &error))?;
    std::fs::write(&json, document + "\n").map_err(|error| context(&json, &error))?;
    Bars::draw(&panels(ladder), &svg).map_err(|error| error.to_string())?;
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

//! `surefoot reproduce`

use super::report::percent;
use super::{RUN_FAILED, bad_input, complain, print};
use crate::experiments::robot_figures::{
    EXPERIMENT_1, EXPERIMENT_2, READING, RobotFigure, experiment_1_figures, experiment_2_figures,
};
use crate::experiments::{Comparison, Figure, box_drop, double_pendulum, free_body};
use clap::Parser;
use clap::builder::PossibleValuesParser;
use indicatif::ProgressBar;
use serde_json::json;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;
use surefoot_sim::written::write_text;

/// Options of `reproduce`.
#[derive(Debug, Parser)]
pub struct Options {
    /// What to reproduce: a table, a figure, or all
    #[arg(value_parser = names(), default_value = "all", hide_default_value = true)]
    figure: String,
    /// Where drawings go
    #[arg(long, default_value = "out/reproduce")]
    out: PathBuf,
    /// One JSON document instead of tables
    #[arg(long)]
    json: bool,
}

const FREE_BODY: [&str; 6] =
    ["table-2.1", "figure-2.2", "figure-2.3", "figure-2.4", "figure-2.5", "figure-2.6"];
const DOUBLE_PENDULUM: [&str; 7] = [
    "table-2.2",
    "figure-2.7",
    "figure-2.8",
    "figure-2.9",
    "figure-2.10",
    "figure-2.11",
    "figure-2.12",
];
const BOX_DROP: [&str; 4] = ["figure-5.3", "figure-5.4", "figure-5.5", "figure-5.6"];

/// Everything that can be asked for.
fn names() -> PossibleValuesParser {
    let all = FREE_BODY.into_iter().chain(DOUBLE_PENDULUM).chain(EXPERIMENT_1);
    let all = all.chain(EXPERIMENT_2).chain(BOX_DROP);
    PossibleValuesParser::new(all.chain(["all"]))
}

/// Reproduces and compares.
pub fn reproduce(options: &Options) -> ExitCode {
    let wanted = |name: &str| options.figure == "all" || options.figure == name;
    let mut items = Vec::new();
    let made = [
        (&FREE_BODY[..], free_body_items as fn() -> Made),
        (&DOUBLE_PENDULUM[..], double_pendulum_items),
        (&EXPERIMENT_1[..], || robot_items(experiment_1_figures()?)),
        (&EXPERIMENT_2[..], || robot_items(experiment_2_figures()?)),
        (&BOX_DROP[..], box_drop_items),
    ];
    for (names, make) in made {
        if !names.iter().any(|name| wanted(name)) {
            continue;
        }
        let spinner = ProgressBar::new_spinner().with_message(names[0]);
        spinner.enable_steady_tick(Duration::from_millis(100));
        let made = make();
        spinner.finish_and_clear();
        match made {
            Ok(made) => items.extend(made.into_iter().filter(|item| wanted(item.name))),
            Err(error) => {
                complain(format_args!("error: {}: {error}", names[0]));
                return ExitCode::from(RUN_FAILED);
            }
        }
    }
    let mut documents = Vec::new();
    for item in &items {
        let file = match item.draw(&options.out) {
            Ok(file) => file,
            Err(message) => return bad_input(&message, options.json),
        };
        if options.json {
            let Item { name, reading, rows, .. } = item;
            documents
                .push(json!({ "figure": name, "reading": reading, "rows": rows, "file": file }));
        } else {
            if let Err(status) = print(&item.text(file.as_deref())) {
                return status;
            }
        }
    }
    if options.json {
        let document = match documents.len() {
            1 => documents.remove(0),
            _ => json!(documents),
        };
        if let Err(status) = print(&format!("{document:#}\n")) {
            return status;
        }
    }
    let missed = items.iter().flat_map(|item| &item.rows).filter(|row| row.met == Some(false));
    match missed.count() {
        0 => {}
        missed => complain(format_args!(
            "{missed} rows are farther from the printed figure than required"
        )),
    }
    ExitCode::SUCCESS
}

/// A table or a figure.
struct Item {
    name: &'static str,
    reading: &'static str,
    rows: Vec<Comparison>,
    /// The drawing; a table has none.
    svg: Option<String>,
}

impl Item {
    fn table(name: &'static str, reading: &'static str, rows: Vec<Comparison>) -> Self {
        Self { name, reading, rows, svg: None }
    }

    fn figures(figures: Vec<Figure>) -> Made {
        let item = |figure: Figure| {
            let Figure { name, reading, chart, rows } = figure;
            Ok(Self { name, reading, rows, svg: Some(chart.svg()?) })
        };
        figures.into_iter().map(item).collect()
    }

    /// Writes a figure's drawing.
    fn draw(&self, folder: &Path) -> Result<Option<PathBuf>, String> {
        let Some(svg) = &self.svg else { return Ok(None) };
        let path = folder.join(format!("{}.svg", self.name));
        std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", path.display()))?;
        write_text(&path, svg)?;
        Ok(Some(path))
    }

    fn text(&self, file: Option<&Path>) -> String {
        let mut out = String::new();
        // Writing to a string cannot fail.
        let _ = writeln!(out, "{}: {}", self.name, self.reading);
        if !self.rows.is_empty() {
            let _ = writeln!(out, "  {:<40}{:>12}{:>12}{:>9}", "", "ours", "printed", "diff");
        }
        for row in &self.rows {
            let _ = writeln!(
                out,
                "  {:<40}{:>12}{:>12.3e}{:>9}{}",
                row.figure,
                row.ours.map_or_else(|| "none".to_owned(), |ours| format!("{ours:.3e}")),
                row.printed,
                percent(row.relative_difference),
                if row.met == Some(false) { "  MISSED" } else { "" },
            );
        }
        if let Some(file) = file {
            let _ = writeln!(out, "  drawn: {}", file.display());
        }
        out
    }
}

/// Items, or why there are none.
type Made = Result<Vec<Item>, Box<dyn std::error::Error>>;

fn free_body_items() -> Made {
    let runs = free_body::Runs::new()?;
    let mut items = vec![Item::table("table-2.1", free_body::READING, runs.table_2_1())];
    items.extend(Item::figures(runs.figures())?);
    Ok(items)
}

fn box_drop_items() -> Made {
    Item::figures(box_drop::Run::new()?.figures())
}

fn double_pendulum_items() -> Made {
    let runs = double_pendulum::Runs::new()?;
    let mut items = vec![Item::table("table-2.2", double_pendulum::READING, runs.table_2_2())];
    items.extend(Item::figures(runs.figures())?);
    Ok(items)
}

fn robot_items(figures: Vec<RobotFigure>) -> Made {
    let item =
        |RobotFigure { name, svg, rows }| Item { name, reading: READING, rows, svg: Some(svg) };
    Ok(figures.into_iter().map(item).collect())
}

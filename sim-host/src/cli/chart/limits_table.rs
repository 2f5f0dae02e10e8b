//! Limits of a control loop as text, CSV and JSON.

use crate::report::Table;
use crate::stability::loop_limits::{
    ACCELEROMETER_NOISE, Cell, Footing, Found, GYROSCOPE_NOISE, HALVINGS, Loop, Manner, Quantity,
    RUNAWAY, Survey, Tolerance,
};
use serde::Serialize;
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::Path;
use surefoot::model::robots::biped;
use surefoot_sim::written::write_rows;

/// A row of the CSV file: one limit.
#[derive(Serialize)]
struct Row {
    quantity: Quantity,
    footing: String,
    control: Loop,
    unit: &'static str,
    in_scene: Option<f64>,
    kind: &'static str,
    value: f64,
    fails_from: Option<f64>,
    manner: &'static str,
    tolerance: f64,
    tolerance_is_relative: bool,
    longest_step_s: f64,
    value_at_half_step: f64,
    manner_at_half_step: &'static str,
    steps_agree: bool,
    least_over_steps: f64,
    greatest_over_steps: f64,
}

/// A table: a row for each quantity, columns for each footing.
pub(super) fn text(survey: &Survey, cells: &[Cell]) -> String {
    let mut out = String::new();
    let scene = survey.scene;
    // Writing to a string cannot fail.
    let _ = writeln!(
        out,
        "Limits of {}. A value works if {}.\n\nFrom the easy end of its range each is tried outward until \
         the first that fails, and bisected before that;\nwhether something beyond works again is not \
         asked. Halving the step changes a limit by less than its tolerance, but for ~. The loop has its \
         supervisor;\nbare: without.\n",
        scene.name,
        survey.criterion.words(),
    );
    let columns = Footing::of(scene);
    let _ = write!(out, "{:<23}{:>10}{:>9}", "", "scene", "within");
    for footing in columns {
        let _ = write!(
            out,
            "  │{:>11}  {:<17}{:>9}{:>11}{:>11}  {:<17}",
            footing.words(),
            "fails by",
            "step",
            "half step",
            "bare",
            "fails by"
        );
    }
    out.push('\n');
    let mut notes = String::new();
    for quantity in survey.quantities {
        let row: Vec<&Cell> = cells.iter().filter(|cell| cell.quantity == *quantity).collect();
        if row.is_empty() {
            continue;
        }
        let own = quantity.of(scene).map_or("–".into(), |x| shown(*quantity, x));
        let within = match quantity.tolerance() {
            Tolerance::Relative(share) => format!("{} %", 100.0 * share),
            Tolerance::Absolute(x) => shown(*quantity, x),
        };
        let _ = write!(out, "{:<23}{own:>10}{within:>9}", quantity.words());
        for cell in row {
            let (Some(limit), Some(half)) = (cell.limit(), cell.at_half_step()) else {
                continue;
            };
            let mark = if cell.agrees() { "" } else { "~" };
            let shown = format!("{mark}{}", found(*quantity, &limit.found));
            let words = limit.found.manner().map_or("–", Manner::words);
            let _ = match cell.control {
                Loop::Supervised => write!(
                    out,
                    "  │{shown:>11}  {words:<17}{:>9}{:>11}",
                    format!("{} ms", 1e3 * limit.longest_step_s),
                    found(*quantity, &half.found),
                ),
                Loop::Bare => write!(out, "{shown:>11}  {words:<17}"),
            };
            note(&mut notes, cell);
        }
        out.push('\n');
    }
    out.push_str(&notes);
    out.push_str(&references(survey, cells));
    out
}

/// The limits on a scene's own soles in a line.
pub(super) fn in_a_line(survey: &Survey, cells: &[Cell]) -> String {
    let own = Footing::of(survey.scene).first();
    let own = |cell: &&Cell| Some(&cell.footing) == own && cell.control == Loop::Supervised;
    let limits = cells.iter().filter(own).filter_map(|cell| {
        let limit = found(cell.quantity, &cell.limit()?.found);
        Some(format!("{} {limit}", cell.quantity.words()))
    });
    format!("{}: {}", survey.scene.name, limits.collect::<Vec<_>>().join(", "))
}

/// The same for a page: of each footing the limit and how it fails beyond.
pub(super) fn for_page(survey: &Survey, cells: &[Cell], files: Vec<String>) -> Table {
    let footings = Footing::of(survey.scene);
    let mut head = vec![String::new(), "scene".to_owned()];
    for footing in footings {
        let words = ["fails by", "bare", "fails by"].map(str::to_owned);
        head.push(footing.words());
        head.extend(words);
    }
    let row = |quantity: &Quantity| {
        let limits: Vec<_> = cells
            .iter()
            .filter(|cell| cell.quantity == *quantity)
            .filter_map(|cell| Some((cell, cell.limit()?)))
            .collect();
        let own = quantity.of(survey.scene).map_or("–".into(), |x| shown(*quantity, x));
        let mut row = vec![quantity.words().to_owned(), own];
        for (cell, limit) in &limits {
            let mark = if cell.agrees() { "" } else { "~" };
            row.push(format!("{mark}{}", found(*quantity, &limit.found)));
            row.push(limit.found.manner().map_or("–", Manner::words).to_owned());
        }
        (!limits.is_empty()).then_some(row)
    };
    Table {
        title: survey.scene.name.clone(),
        head,
        rows: survey.quantities.iter().filter_map(row).collect(),
        note: format!(
            "A value works if {}. ~: halving the step moves the limit by more than the tolerance. !: the end of \
             the range that was searched. {}",
            survey.criterion.words().replace('\n', " "),
            references(survey, cells).replace('\n', " ")
        ),
        files,
    }
}

/// What multiples and shares are of.
fn references(survey: &Survey, cells: &[Cell]) -> String {
    let mut out = String::new();
    let has = |quantity| cells.iter().any(|cell| cell.quantity == quantity);
    if has(Quantity::GainScale) {
        out.push_str("Gains: Kp times the scale, Kv times its root.\n");
    }
    if has(Quantity::Noise) {
        let _ = writeln!(
            out,
            "Sensor noise: times {GYROSCOPE_NOISE:.2e} rad/s/√Hz and {ACCELEROMETER_NOISE:.2e} m/s²/√Hz \
             (an MPU-6050's); seed {}.",
            survey.scene.sensing.seed,
        );
    }
    let runs_away = |cell: &Cell| {
        cell.limit().is_some_and(|limit| limit.found.manner() == Some(Manner::Runaway))
    };
    if cells.iter().any(runs_away) {
        let _ = writeln!(
            out,
            "Runaway: torques beyond {RUNAWAY} times the biped's limits with a sole flat on the floor, or not \
             for long off it."
        );
    }
    if has(Quantity::TorqueShare) {
        let limits = biped::LIMITS.joints[0].map(|joint| joint.torque);
        let _ = writeln!(out, "Torque limits: of {limits:?} N·m, hip to foot.");
    }
    out
}

/// What a cell's figures do not say.
fn note(out: &mut String, cell: &Cell) {
    let quantity = cell.quantity;
    let place = match cell.control {
        Loop::Supervised => cell.footing.words(),
        Loop::Bare => format!("{}, bare", cell.footing.words()),
    };
    let Some(limit) = cell.limit() else { return };
    let _ = match limit.found {
        Found::Limit { .. } => Ok(()),
        Found::EasyEndFails { at, .. } => {
            let at = shown(quantity, at);
            writeln!(out, "! {}, {place}: the easy end of its range, {at}, fails", quantity.words())
        }
        Found::FarEndWorks { to } => {
            let to = shown(quantity, to);
            writeln!(out, "! {}, {place}: the far end of its range, {to}, works", quantity.words())
        }
    };
    if !cell.agrees() {
        let (low, high) = cell.spread();
        let _ = writeln!(
            out,
            "~ {}, {place}: no two steps down to 1/{} of the scene's agree; they find {} to {}",
            quantity.words(),
            1 << HALVINGS,
            shown(quantity, low),
            shown(quantity, high),
        );
    }
}

fn found(quantity: Quantity, found: &Found<Manner>) -> String {
    let value = shown(quantity, found.value());
    match found {
        Found::Limit { .. } => value,
        Found::EasyEndFails { .. } => format!("!{value}"),
        Found::FarEndWorks { .. } => format!("!{value}"),
    }
}

/// As many digits as the tolerance is worth, in a unit that people use.
fn shown(quantity: Quantity, value: f64) -> String {
    let digits = |x: f64| (2 - x.abs().max(1e-9).log10().floor() as i32).clamp(0, 6) as usize;
    match quantity {
        Quantity::Delay => format!("{:.1} ms", 1e3 * value),
        Quantity::SetPointHeight => format!("{:.2} cm", 100.0 * value),
        Quantity::TorqueShare => format!("{:.1} %", 100.0 * value),
        Quantity::BlockSpeed | Quantity::ControlRate => {
            format!("{value:.*} {}", digits(value), quantity.unit())
        }
        Quantity::GainScale | Quantity::Noise => format!("{value:.*}×", digits(value)),
        Quantity::Friction => format!("{value:.*}", digits(value)),
    }
}

fn rows(survey: &Survey, cells: &[Cell]) -> Vec<Row> {
    let row = |cell: &Cell| {
        let (limit, half) = (cell.limit()?, cell.at_half_step()?);
        let (tolerance, tolerance_is_relative) = match cell.quantity.tolerance() {
            Tolerance::Relative(share) => (share, true),
            Tolerance::Absolute(distance) => (distance, false),
        };
        let (kind, fails_from) = match limit.found {
            Found::Limit { fails, .. } => ("limit", Some(fails)),
            Found::EasyEndFails { at, .. } => ("easy-end-fails", Some(at)),
            Found::FarEndWorks { .. } => ("far-end-works", None),
        };
        let words = |found: &Found<Manner>| found.manner().map_or("none", Manner::words);
        let (least_over_steps, greatest_over_steps) = cell.spread();
        Some(Row {
            quantity: cell.quantity,
            footing: cell.footing.words(),
            control: cell.control,
            unit: cell.quantity.unit(),
            in_scene: cell.quantity.of(survey.scene),
            kind,
            value: limit.found.value(),
            fails_from,
            manner: words(&limit.found),
            tolerance,
            tolerance_is_relative,
            longest_step_s: limit.longest_step_s,
            value_at_half_step: half.found.value(),
            manner_at_half_step: words(&half.found),
            steps_agree: cell.agrees(),
            least_over_steps,
            greatest_over_steps,
        })
    };
    cells.iter().filter_map(row).collect()
}

/// One row a limit.
pub(super) fn write_csv(path: &Path, survey: &Survey, cells: &[Cell]) -> Result<(), String> {
    write_rows(path, |writer| rows(survey, cells).iter().try_for_each(|row| writer.serialize(row)))
}

/// Everything, searches at all steps included.
pub(super) fn json(survey: &Survey, cells: &[Cell]) -> Value {
    let searched: Vec<Value> = survey
        .quantities
        .iter()
        .filter_map(|quantity| {
            let (ladder, tolerance) = (quantity.ladder(survey.scene)?, quantity.tolerance());
            Some(json!({ "quantity": quantity, "unit": quantity.unit(), "ladder": ladder, "tolerance": tolerance }))
        })
        .collect();
    json!({
        "chart": "stability",
        "scene": survey.scene.name,
        "criterion": survey.criterion,
        "works_if": survey.criterion.words().replace('\n', " "),
        "islands_beyond_the_first_failure": "not looked for",
        "searched": searched,
        "limits": rows(survey, cells),
        "cells": cells,
    })
}

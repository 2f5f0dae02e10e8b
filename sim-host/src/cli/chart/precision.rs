//! `surefoot chart work-precision`

use super::super::complain;
use super::{Made, Options, this_program};
use crate::precision::{
    ControllerPrecision, Effort, Mujoco, PROBLEMS, Survey, controller_figures,
    controller_precision, figures, file_of, machine, precision_chapter, survey, write_rows,
};
use indicatif::ProgressBar;
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;
use surefoot_sim::written::write_text;

/// Charts all problems, or those that are asked for.
pub(super) fn chart(options: &Options) -> Result<Made, String> {
    let names: Vec<&str> = match options.problem.as_slice() {
        [] => PROBLEMS.to_vec(),
        asked => asked.iter().map(String::as_str).collect(),
    };
    let surveys = find(&names, options)?;
    let controller = controller_precision(true).map_err(|error| error.to_string())?;
    let json = json!({
        "chart": "work-precision", "machine": machine(), "surveys": surveys, "controller": controller,
    });
    Ok(Made {
        files: write_files(&options.out, &surveys, &controller, &json)?,
        text: text(&surveys) + &controller_text(&controller),
        json,
        chapter: precision_chapter(&surveys, &controller).map_err(|error| error.to_string())?,
    })
}

fn find(names: &[&str], options: &Options) -> Result<Vec<Survey>, String> {
    let folder = options.out.join("work-precision");
    if options.fresh && folder.exists() {
        std::fs::remove_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    }
    let program = this_program()?;
    let peers = options.peers.then(|| Mujoco::start().map(Arc::new));
    if let Some(Err(error)) = &peers {
        complain(format_args!("without peers: {error}"));
    }
    let bar = ProgressBar::new_spinner();
    bar.enable_steady_tick(Duration::from_millis(500));
    let each = names.iter().enumerate().map(|(k, name)| {
        bar.set_message(format!("{name} ({} of {})", k + 1, names.len()));
        let done =
            |part: &str| bar.set_message(format!("{name} ({} of {}): {part}", k + 1, names.len()));
        survey(name, &Effort::CHART, peers.as_ref(), &folder, &program, &done)
            .map_err(|error| error.to_string())
    });
    let all = each.collect();
    bar.finish_and_clear();
    all
}

fn write_files(
    folder: &Path,
    surveys: &[Survey],
    controller: &ControllerPrecision,
    document: &Value,
) -> Result<Vec<PathBuf>, String> {
    let mut files = Vec::new();
    let mut put = |name: String, text: &str| -> Result<(), String> {
        let path = folder.join(name);
        write_text(&path, text)?;
        files.push(path);
        Ok(())
    };
    for survey in surveys {
        for figure in figures(survey).map_err(|error| error.to_string())? {
            put(file_of(&survey.problem, &figure), &figure.svg)?;
        }
    }
    for figure in controller_figures(controller).map_err(|error| error.to_string())? {
        put(file_of("controller", &figure), &figure.svg)?;
    }
    put("work-precision.json".to_owned(), &format!("{document:#}\n"))?;
    let table = folder.join("work-precision.csv");
    write_rows(&table, surveys).map_err(|error| format!("{}: {error}", table.display()))?;
    files.push(table);
    Ok(files)
}

fn text(surveys: &[Survey]) -> String {
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = writeln!(out, "{}", machine());
    for survey in surveys {
        let _ =
            writeln!(out, "\n{}: {}, {} s", survey.problem, survey.description, survey.duration_s);
        let _ = writeln!(
            out,
            "reference: {}, checked by {}: {:.1e} apart",
            survey.reference, survey.checked_by, survey.apart
        );
        let _ = writeln!(
            out,
            "  {:<26}{:>7}{:>7}{:>11}{:>11}{:>13}{:>12}",
            "method", "order", "fitted", "step, s", "error", "time, ms/s", "band, J"
        );
        for curve in survey.curves.iter().chain(&survey.peers) {
            for (place, m) in curve.measurements.iter().enumerate() {
                let (name, order, fit) = match place {
                    0 => (
                        curve.method.as_str(),
                        curve.order.map_or("–".to_owned(), |order| order.to_string()),
                        curve.fit.map_or("–".to_owned(), |fit| format!("{:.2}", fit.order)),
                    ),
                    _ => ("", String::new(), String::new()),
                };
                let number = |x: Option<f64>| x.map_or("–".to_owned(), |x| format!("{x:.2e}"));
                let time = m.time.map_or("–".to_owned(), |time| {
                    let doubt = if time.is_doubtful() { "~" } else { "" };
                    format!("{doubt}{:.4}", 1e3 * time.median)
                });
                let _ = writeln!(
                    out,
                    "  {name:<26}{order:>7}{fit:>7}{:>11.3e}{:>11}{time:>13}{:>12}{}",
                    m.step_s,
                    number(m.error),
                    number(m.energy_band_j),
                    m.failure.as_ref().map_or(String::new(), |f| format!("  {}", f.reason)),
                );
            }
        }
        for omission in &survey.omitted {
            let _ = writeln!(out, "  {:<26}left out: {}", omission.method, omission.reason);
        }
    }
    out
}

fn controller_text(controller: &ControllerPrecision) -> String {
    let mut out =
        "\ncontroller, on all states of Experiment 1, against the exact foot in f64\n".to_owned();
    let number = |x: Option<f64>| x.map_or("–".to_owned(), |x| format!("{x:.1e}"));
    let _ = writeln!(
        out,
        "  {:<22}{:<8}{:>12}{:>12}{:>9}{:>14}{:>12}",
        "form", "scalar", "worst", "median", "faults", "instructions", "tick, µs"
    );
    for row in &controller.torques {
        let (form, count) = (row.form.to_string(), row.instructions);
        let count = count.map_or("–".to_owned(), |count| count.to_string());
        let scalar = format!("{:?}", row.form.scalar).to_lowercase();
        let tick = row.tick.map_or("–".to_owned(), |tick| format!("{:.2}", 1e6 * tick.median));
        let (worst, median) = (number(row.largest), number(row.median));
        let _ = writeln!(
            out,
            "  {form:<22}{scalar:<8}{worst:>12}{median:>12}{:>9}{count:>14}{tick:>12}",
            row.faults
        );
    }
    if let Some(reason) = &controller.uncounted {
        let _ = writeln!(out, "  instructions: {reason}");
    }
    let _ = writeln!(out, "  {:<12}{:>16}{:>20}", "rate, Hz", "position, m", "orientation, rad");
    for row in &controller.tracking {
        let (position, orientation) = (number(row.position_m), number(row.orientation_rad));
        let _ = writeln!(out, "  {:<12.0}{position:>16}{orientation:>20}", row.rate_hz);
    }
    out
}

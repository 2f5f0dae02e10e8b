//! `surefoot advise`

use super::recommended::ACCURACY;
use super::{RUN_FAILED, bad_input, complain, say};
use crate::precision::{
    Advice, AdviceError, Among, Choice, Effort, Problem, STEP_MARGIN, advise as advised, cost, step,
};
use clap::Parser;
use indicatif::ProgressBar;
use std::fmt::Write;
use std::process::ExitCode;
use std::time::Duration;
use surefoot_sim::scene::{AnyScene, open};

/// Options of `advise`.
#[derive(Debug, Parser)]
pub struct Options {
    /// A built-in scene or a TOML file; its own method and step do not matter
    scene: String,
    /// Largest error of the trajectory that is wanted, over how far the motion reaches
    #[arg(long, default_value_t = ACCURACY)]
    accuracy: f64,
    /// Simulated time, s, in place of the scene's
    #[arg(long)]
    duration: Option<f64>,
    /// One JSON document instead of a table
    #[arg(long)]
    json: bool,
}

/// Advises.
pub fn advise(options: &Options) -> ExitCode {
    if !(options.accuracy > 0.0 && options.accuracy < 1.0) {
        let message = format!("--accuracy {}: expected a number between 0 and 1", options.accuracy);
        return bad_input(&message, options.json);
    }
    let problem = match open_for(options) {
        Ok(problem) => problem,
        Err(message) => return bad_input(&message, options.json),
    };
    let bar = ProgressBar::new_spinner();
    bar.set_message("all methods, from coarse steps to fine ones");
    bar.enable_steady_tick(Duration::from_millis(500));
    let advice = advised(&problem, options.accuracy, Among::All, &Effort::ADVICE);
    bar.finish_and_clear();
    match advice {
        Ok(advice) => {
            let document = serde_json::json!({ "advice": advice });
            let text = if options.json { format!("{document:#}\n") } else { text(&advice) };
            say(&text, ExitCode::SUCCESS)
        }
        Err(error) => none(&error, options.json),
    }
}

fn open_for(options: &Options) -> Result<Problem, String> {
    let mut scene = open(&options.scene).map_err(|error| error.to_string())?;
    let checked = match (&mut scene, options.duration) {
        (_, None) => Ok(()),
        (AnyScene::Robot(scene), Some(duration)) => {
            scene.duration_s = duration;
            scene.check()
        }
        (AnyScene::Mechanism(scene), Some(duration)) => {
            scene.duration_s = duration;
            scene.check()
        }
    };
    checked.map_err(|error| error.to_string())?;
    Problem::of_scene(&scene).map_err(|error| error.to_string())
}

fn none(error: &AdviceError, json: bool) -> ExitCode {
    complain(format_args!("no advice: {error}"));
    let status = ExitCode::from(RUN_FAILED);
    if !json {
        return status;
    }
    let failure = serde_json::json!({ "kind": "no-advice", "message": error.to_string() });
    say(&format!("{:#}\n", serde_json::json!({ "failure": failure })), status)
}

fn text(advice: &Advice) -> String {
    let Advice { choice, tried, .. } = advice;
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = writeln!(out, "{}, to {:.1e} of how far it reaches:", advice.problem, advice.accuracy);
    let _ = writeln!(out, "  {} with {}", choice.method, step(choice));
    if choice.tolerance.is_none() {
        let _ = writeln!(out, "  run --integrator {} --step {:e}", choice.method, choice.step_s);
    }
    let _ = writeln!(
        out,
        "  error {:.1e} when tried{}",
        tried.error.unwrap_or(f64::NAN),
        tried.time.map_or(String::new(), |time| format!(
            ", {:.3} ms a simulated second (quartiles {:.0} % apart)",
            1e3 * time.median,
            100.0 * time.spread
        ))
    );
    let _ = match choice.fails_from_s {
        Some(h) => {
            writeln!(out, "  {:.2} of the shortest step that fails, {h:.2e} s", choice.step_s / h)
        }
        None => writeln!(out, "  no step tried fails"),
    };
    let _ = match choice.foretold_s {
        Some(h) => {
            writeln!(out, "  {:.2} of the longest step foretold, {h:.2e} s", choice.step_s / h)
        }
        None => writeln!(out, "  no limit of the step is foretold"),
    };
    let _ = writeln!(out, "  (at most {STEP_MARGIN} of either)");
    if let Some((next, rest)) = advice.others.split_first() {
        let _ = writeln!(out, "next best: {}", line(next));
        for choice in rest {
            let _ = writeln!(out, "           {}", line(choice));
        }
    }
    if !advice.too_coarse.is_empty() {
        let _ =
            writeln!(out, "not that accurate at any step tried: {}", advice.too_coarse.join(", "));
    }
    for omission in &advice.omitted {
        let _ = writeln!(out, "left out: {}: {}", omission.method, omission.reason);
    }
    let [by, checked] = &advice.reference;
    let _ = writeln!(out, "reference: {by}, checked by {checked}; sure to {:.1e}", advice.apart);
    out
}

fn line(choice: &Choice) -> String {
    format!("{} with {}, {}", choice.method, step(choice), cost(choice))
}
